#include "tools/api/open/program_types.h"

#include <mutex>
#include <utility>

#include "tools/api/open/sources.h"

namespace forage {
namespace {

template <class Type>
using Versions = std::map<std::string, std::pair<Type, std::string>>;

struct ProgramTypes {
    std::mutex mutex;
    Versions<NeuronType> neurons;
    Versions<SynapseType> synapses;
    Versions<ModuleType> modules;
};

ProgramTypes& all() {
    static auto* const types = new ProgramTypes;  // outlives all threads that may still read it
    return *types;
}

template <class Type>
void put(Versions<Type>& types, Type type, std::string version) {
    Registry registry = forage_types();
    registry.add(type);  // throws for an inconsistent declaration
    const std::lock_guard lock(all().mutex);
    std::string name = type.name;
    types.insert_or_assign(std::move(name), std::pair(std::move(type), std::move(version)));
}

}  // namespace

void add_program_type(NeuronType type, std::string version) {
    put(all().neurons, std::move(type), std::move(version));
}
void add_program_type(SynapseType type, std::string version) {
    put(all().synapses, std::move(type), std::move(version));
}
void add_program_type(ModuleType type, std::string version) {
    put(all().modules, std::move(type), std::move(version));
}

void clear_program_types() {
    auto& types = all();
    const std::lock_guard lock(types.mutex);
    types.neurons.clear(), types.synapses.clear(), types.modules.clear();
}

std::map<std::string, std::string> program_types() {
    auto& types = all();
    const std::lock_guard lock(types.mutex);
    std::map<std::string, std::string> out;
    const auto list = [&](const auto& from) {
        for (const auto& [name, t] : from) out[name] = t.second;
    };
    list(types.neurons), list(types.synapses), list(types.modules);
    return out;
}

bool has_program_types() { return !program_types().empty(); }

void add_program_types(Registry& registry) {
    auto& types = all();
    const std::lock_guard lock(types.mutex);
    for (const auto& [name, t] : types.neurons) registry.add(t.first);
    for (const auto& [name, t] : types.synapses) registry.add(t.first);
    for (const auto& [name, t] : types.modules) registry.add(t.first);
}

std::map<std::string, std::string> program_types_of(const model::System& system) {
    auto& types = all();
    const std::lock_guard lock(types.mutex);
    std::map<std::string, std::string> out;
    const auto note = [&](const auto& among, const std::string& name) {
        if (const auto it = among.find(name); it != among.end()) out[name] = it->second.second;
    };
    for (const auto& p : system.processes) {
        for (const auto& g : p.groups) note(types.neurons, g.neuron.type);
        if (p.module) note(types.modules, p.module->type);
    }
    for (const auto& c : system.connections)
        if (c.synapse) note(types.synapses, c.synapse->type);
    return out;
}

}  // namespace forage
