#include "core/types/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace forage {
namespace {

template <class Map>
auto find(const Map& map, std::string_view name) -> const typename Map::mapped_type* {
    const auto it = map.find(name);
    return it == map.end() ? nullptr : &it->second;
}

template <class Map>
void insert(Map& map, typename Map::mapped_type type, std::string_view kind) {
    if (type.name.empty()) throw std::invalid_argument(fmt::format("a {} type without a name", kind));
    for (std::size_t i = 0; i < type.parameters.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (type.parameters[i].name == type.parameters[j].name)
                throw std::invalid_argument(
                    fmt::format("{} type '{}' declares the parameter '{}' twice", kind, type.name, type.parameters[i].name));
    const std::string name = type.name;
    if (!map.emplace(name, std::move(type)).second)
        throw std::invalid_argument(fmt::format("there is already a {} type '{}'", kind, name));
}

template <class Type>
void require_one_output(const Type& type, std::string_view kind) {
    const auto outputs = std::count_if(type.states.begin(), type.states.end(), [](const auto& s) { return s.output; });
    if (outputs != 1)
        throw std::invalid_argument(
            fmt::format("{} type '{}' declares {} output states, it must have exactly one", kind, type.name, outputs));
}

}  // namespace

void Registry::add(NeuronType type) {
    require_one_output(type, "neuron");
    insert(neurons_, std::move(type), "neuron");
}
void Registry::add(SynapseType type) {
    require_one_output(type, "synapse");
    insert(synapses_, std::move(type), "synapse");
}
void Registry::add(ModuleType type) { insert(modules_, std::move(type), "module"); }

const NeuronType* Registry::neuron(std::string_view name) const { return find(neurons_, name); }
const SynapseType* Registry::synapse(std::string_view name) const { return find(synapses_, name); }
const ModuleType* Registry::module(std::string_view name) const { return find(modules_, name); }

}  // namespace forage
