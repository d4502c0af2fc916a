// The types that a system may name. A registry is a value that is passed to functions; there is no global
// list.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/module.h"
#include "core/types/neuron.h"
#include "core/types/synapse.h"

namespace forage {

class Registry {
  public:
    /// Adds a type. Throws std::invalid_argument when its name is taken or its declaration is inconsistent:
    /// it has no name or not exactly one output, or declares a parameter, state, feedback or port twice.
    void add(NeuronType type);
    void add(SynapseType type);
    void add(ModuleType type);

    /// Removes the types that a system has declared.
    void remove_declared();

    /// The type with this name; null when there is none.
    const NeuronType* neuron(std::string_view name) const;
    const SynapseType* synapse(std::string_view name) const;
    const ModuleType* module(std::string_view name) const;

    /// Folders whose plugins are not loaded, so that their types are missing, and what makes them known.
    struct Unloaded {
        std::string folder, hint;
    };
    std::vector<Unloaded> unloaded;

    const auto& neurons() const { return neurons_; }
    const auto& synapses() const { return synapses_; }
    const auto& modules() const { return modules_; }

  private:
    template <class Type>
    using Map = std::map<std::string, Type, std::less<>>;
    Map<NeuronType> neurons_;
    Map<SynapseType> synapses_;
    Map<ModuleType> modules_;
};

/// The names in a map of a registry, for hints.
template <class Map>
std::vector<std::string> names(const Map& map) {
    std::vector<std::string> out;
    for (const auto& [name, type] : map) out.push_back(name);
    return out;
}

}  // namespace forage
