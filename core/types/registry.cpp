#include "core/types/registry.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace forage {
namespace {

template <class Map>
auto find(const Map& map, std::string_view name) -> const typename Map::mapped_type* {
    const auto it = map.find(name);
    return it == map.end() ? nullptr : &it->second;
}

/// Throws when a parameter that is no number has a range.
template <class Type>
void require_numbers(const Type& type, std::string_view kind) {
    for (const auto& p : type.parameters)
        if (p.range && p.kind != ParameterKind::real && p.kind != ParameterKind::integer)
            throw std::invalid_argument(
                fmt::format("{} type '{}' declares a range for the parameter '{}', which is {}", kind,
                            type.name, p.name, describe(p.kind)));
}

/// Throws when two of `items` have the same name. `what` names the kind of the items in the message.
template <class Items, class Type>
void require_distinct(const Items& items, const Type& type, std::string_view kind, std::string_view what) {
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (items[i].name == items[j].name)
                throw std::invalid_argument(fmt::format("{} type '{}' declares the {} '{}' twice", kind,
                                                        type.name, what, items[i].name));
}

template <class Map>
void insert(Map& map, typename Map::mapped_type type, std::string_view kind) {
    if (type.name.empty()) throw std::invalid_argument(fmt::format("a {} type without a name", kind));
    if (std::ranges::any_of(type.name, [](unsigned char c) { return std::isspace(c); }))
        throw std::invalid_argument(fmt::format("{} type '{}' has blanks in its name", kind, type.name));
    require_numbers(type, kind);
    require_distinct(type.parameters, type, kind, "parameter");
    const std::string name = type.name;
    if (!map.emplace(name, std::move(type)).second)
        throw std::invalid_argument(fmt::format("there is already a {} type '{}'", kind, name));
}

template <class Type>
void require_one_output(const Type& type, std::string_view kind) {
    const auto outputs = std::ranges::count_if(type.states, [](const auto& s) { return s.output; });
    if (outputs != 1)
        throw std::invalid_argument(fmt::format(
            "{} type '{}' declares {} output states, it must have exactly one", kind, type.name, outputs));
}

}  // namespace

void Registry::add(NeuronType type) {
    require_one_output(type, "neuron");
    require_distinct(type.states, type, "neuron", "state");
    insert(neurons_, std::move(type), "neuron");
}
void Registry::add(SynapseType type) {
    require_one_output(type, "synapse");
    require_distinct(type.states, type, "synapse", "state");
    require_distinct(type.feedback, type, "synapse", "feedback");
    insert(synapses_, std::move(type), "synapse");
}
void Registry::add(ModuleType type) {
    for (const bool outputs : {false, true}) {  // an input and an output may share a name
        std::vector<ModulePort> ports;
        std::copy_if(type.ports.begin(), type.ports.end(), std::back_inserter(ports),
                     [&](const auto& p) { return p.is_output == outputs; });
        require_distinct(ports, type, "module", outputs ? "output" : "input");
    }
    insert(modules_, std::move(type), "module");
}

void Registry::remove_declared() {
    std::erase_if(neurons_, [](const auto& t) { return t.second.declared; });
    std::erase_if(synapses_, [](const auto& t) { return t.second.declared; });
}

const NeuronType* Registry::neuron(std::string_view name) const { return find(neurons_, name); }
const SynapseType* Registry::synapse(std::string_view name) const { return find(synapses_, name); }
const ModuleType* Registry::module(std::string_view name) const { return find(modules_, name); }

}  // namespace forage
