#include <cstdio>

#include <fmt/format.h>

#include "core/xml/schema.h"
#include "tools/forage/commands.h"

namespace forage::tool {
namespace {

void describe(const std::string& name, const std::string& label, const std::string& doc,
              const std::vector<Parameter>& parameters) {
    fmt::print("{} ({})\n  {}\n", name, label, doc);
    for (const auto& p : parameters) {
        const std::string value = to_text(p.default_value);
        fmt::print(
            "  {:<14} {} Default {}{}{}{}.\n", p.name, p.doc,
            p.kind == ParameterKind::text ? "'" + value + "'" : value, p.unit.empty() ? "" : " " + p.unit,
            p.range ? fmt::format(", usual range {} to {}", to_text(p.range->low), to_text(p.range->high))
                    : "",
            p.at_start ? "; read at start" : "");
    }
}

template <class Type>
void describe_states(const Type& type) {
    for (const auto& s : type.states)
        fmt::print("  state {:<8} {}{}\n", s.name, s.label, s.output ? " (output)" : "");
}

template <class Map>
void list(std::string_view kind, const Map& types) {
    fmt::print("{}\n", kind);
    for (const auto& [name, type] : types) fmt::print("  {:<28} {}\n", name, type.doc);
}

}  // namespace

int schema() {
    fmt::print("{}", xml::relax_ng(shipped_types(nullptr, nullptr)));
    return fine;
}

int types(const std::string& name) {
    const Registry registry = shipped_types(nullptr, nullptr);
    if (name.empty()) {
        list("Neurons", registry.neurons());
        list("Synapses", registry.synapses());
        list("Modules", registry.modules());
        fmt::print("'forage types NAME' describes one.\n");
        return fine;
    }
    if (const auto* neuron = registry.neuron(name)) {
        describe(neuron->name, neuron->label, neuron->doc, neuron->parameters);
        describe_states(*neuron);
        return fine;
    }
    if (const auto* synapse = registry.synapse(name)) {
        describe(synapse->name, synapse->label, synapse->doc, synapse->parameters);
        describe_states(*synapse);
        for (const auto& f : synapse->feedback) fmt::print("  feedback {}  {}\n", f.name, f.label);
        return fine;
    }
    if (const auto* module = registry.module(name)) {
        describe(module->name, module->label, module->doc, module->parameters);
        for (const auto& p : module->ports)
            fmt::print("  {} {:<18} {}{}\n", p.is_output ? "output" : "input ", p.name, p.label,
                       p.optional ? " (optional)" : "");
        return fine;
    }
    std::vector<std::string> all = names(registry.neurons());
    for (const auto& n : names(registry.synapses())) all.push_back(n);
    for (const auto& n : names(registry.modules())) all.push_back(n);
    fmt::print(stderr, "error: there is no type '{}'\n  hint: {}\n", name, suggest(name, all));
    return bad_input;
}

}  // namespace forage::tool
