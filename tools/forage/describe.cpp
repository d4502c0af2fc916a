#include <algorithm>
#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "core/model/lookup.h"
#include "tools/forage/commands.h"

namespace forage::tool {
namespace {

std::string number_of(std::size_t n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string size_of(const model::Group& group) {
    const GroupShape s = model::shape(group.topology);
    return s.cells == s.width * s.height ? fmt::format("{} x {}", s.width, s.height)
                                         : fmt::format("{} of {} x {}", s.cells, s.width, s.height);
}

std::string settings_of(const model::TypeUse& use) {
    std::string out;
    for (const auto& s : use.settings)
        out += fmt::format("{}{}={}", out.empty() ? "" : ", ", s.name, s.value);
    return out.empty() ? out : " (" + out + ")";
}

std::string_view name_of(InputKind kind) {
    constexpr std::string_view names[] = {"excitatory", "inhibitory", "modulatory"};
    return names[static_cast<std::size_t>(kind)];
}

/// Facts about a compiled connection.
struct Compiled {
    std::size_t synapses;
    std::string_view form;
};

void print_connection(const model::Connection& c, const std::string& target, const Compiled& compiled) {
    fmt::print("      -> {}: {}, {} ({}), {}{}, '{}'\n", target, name_of(c.kind),
               number_of(compiled.synapses, "synapse"), compiled.form, c.synapse->type,
               settings_of(*c.synapse), model::trim(c.name));
}

void print_module(const model::ModuleUse& module, bool enabled, const model::System& system,
                  const model::GroupIndex& groups) {
    fmt::print("    module {}{}{}\n", module.type, enabled ? "" : ", switched off", settings_of(module));
    for (const auto* references : {&module.inputs, &module.outputs})
        for (const auto& r : *references) {
            const auto entry = groups.find(r.target);
            if (entry.group)
                fmt::print("      {} {}: {}\n", references == &module.inputs ? "reads" : "writes", r.name,
                           model::path(system, *entry.process, *entry.group));
        }
}

}  // namespace

int describe(const RunInput& input) {
    Diagnostics diagnostics;
    const auto loaded = load(input, diagnostics);
    const auto simulation = compile(loaded, input.seed, diagnostics);
    fmt::print(stderr, "{}", format(diagnostics));
    if (!simulation) return bad_input;

    const model::System& system = loaded->system;
    std::map<std::string_view, Compiled> compiled;
    std::size_t synapses = 0, cells = 0, groups = 0;
    const auto& connections = simulation->layout().connections;
    for (int i = 0; i < std::ssize(connections); ++i) {
        compiled[connections[i].id] = {simulation->synapses(i), simulation->connection_form(i)};
        synapses += simulation->synapses(i);
    }
    for (const auto& p : system.processes)
        for (const auto& g : p.groups)
            ++groups, cells += static_cast<std::size_t>(model::shape(g.topology).cells);
    fmt::print(
        "{}: {}, {} ({}), {} ({})\n", model::trim(system.name),
        system.processes.size() == 1 ? "1 process" : fmt::format("{} processes", system.processes.size()),
        number_of(groups, "group"), number_of(cells, "cell"),
        number_of(system.connections.size(), "connection"), number_of(synapses, "synapse"));

    const model::GroupIndex index(system);
    for (const auto& p : system.processes) {
        fmt::print("\n{}{}\n", model::trim(p.name), p.path.empty() ? "" : ", linked to " + p.path);
        if (p.module) print_module(*p.module, p.module_enabled, system, index);
        for (const auto& g : p.groups) {
            fmt::print("    {}: {}, {}{}\n", model::trim(g.name), size_of(g), g.neuron.type,
                       settings_of(g.neuron));
            for (const auto& c : system.connections) {
                if (c.source != g.id) continue;
                const auto target = index.find(c.target);
                print_connection(c,
                                 target.process == &p ? std::string(model::trim(target.group->name))
                                                      : model::path(system, *target.process, *target.group),
                                 compiled[c.id]);
            }
        }
    }
    return fine;
}

}  // namespace forage::tool
