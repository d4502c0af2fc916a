#include "tools/plot/structure.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/connectivity/grid.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "tools/plot/connection.h"
#include "tools/plot/diagram.h"
#include "tools/plot/wiring.h"

namespace forage::plot {
namespace {

const model::Process* find_process(const model::System& system, std::string_view name) {
    const auto found = model::items_named(system.processes, name);
    return found.empty() ? nullptr : &system.processes[found.front()];
}

/// The input that each synapse delivers for an activity of 1.
std::vector<double> strengths(const model::Connection& c, const connectivity::Synapses& synapses,
                              const SynapseType& type, const engine::Simulation* simulation) {
    std::vector<double> out(synapses.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = synapses.reference - synapses.attenuation[i];
    if (type.has_gain) {
        const auto instance = type.make();
        model::apply(model::synapse_of(c), type.parameters, instance->parameters());
        for (double& v : out) v *= instance->gain();
        for (std::size_t i = 0; i < synapses.weight.size(); ++i) out[i] *= synapses.weight[i];
        return out;
    }
    const auto weight = std::ranges::find(type.states, "weight", &SynapseStateInfo::name);
    if (weight == type.states.end()) return out;
    ConstColumn learned(nullptr, 0);
    for (int i = 0; simulation && i < std::ssize(simulation->layout().connections); ++i)
        if (simulation->layout().connections[i].id == c.id)
            new (&learned)
                ConstColumn(simulation->synapse_state(i, static_cast<int>(weight - type.states.begin())));
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] *= learned.size() ? learned[static_cast<Index>(i)] : 0;
    return out;
}

/// The cell at each position of a group, row by row; -1 where there is none.
std::vector<int> places(const model::Topology& topology) {
    const connectivity::Grid grid(topology);
    std::vector<int> out;
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x) out.push_back(grid.index(grid.left() + x, grid.top() + y));
    return out;
}

/// The two groups of a connection. Throws std::runtime_error when one is missing.
WiringPlot groups_of(const model::Connection& c, const model::System& system) {
    const model::GroupIndex groups(system);
    const auto source = groups.find(c.source), target = groups.find(c.target);
    if (!source.group || !target.group)
        throw std::runtime_error(
            fmt::format("connection '{}' is not complete: 'forage check' says what is wrong", c.name));
    WiringPlot p;
    p.title = c.name;
    p.source = model::trim(source.group->name), p.target = model::trim(target.group->name);
    p.source_shape = model::shape(source.group->topology),
    p.target_shape = model::shape(target.group->topology);
    p.source_places = places(source.group->topology), p.target_places = places(target.group->topology);
    return p;
}

/// A connection plot, or a wiring plot if `wiring` is set.
Picture picture_of(const model::Connection& c, bool wiring, const model::System& system,
                   const Registry& registry, const engine::Simulation* simulation, std::uint64_t seed) {
    WiringPlot p = groups_of(c, system);
    const model::GroupIndex groups(system);
    const auto source = groups.find(c.source), target = groups.find(c.target);
    const SynapseType* type = registry.synapse(model::synapse_of(c).type);
    if (!type)
        throw std::runtime_error(
            fmt::format("connection '{}' is not complete: 'forage check' says what is wrong", c.name));
    Diagnostics diagnostics;
    auto [synapses, strength] = synapses_of(c, system, registry, simulation, seed, diagnostics);
    if (diagnostics.failed()) throw std::runtime_error(format(diagnostics));
    p.subtitle =
        fmt::format("{} {} to {}, {} synapses of {}", name_of(c.kind),
                    model::path(system, *source.process, *source.group),
                    model::path(system, *target.process, *target.group), synapses.size(), type->label);
    p.strength = std::move(strength);
    p.pre = std::move(synapses.pre), p.post = std::move(synapses.post), p.delay = std::move(synapses.delay);
    return wiring ? wiring_plot({p}) : connection_plot(p);
}

}  // namespace

ConnectionSynapses synapses_of(const model::Connection& c, const model::System& system,
                               const Registry& registry, const engine::Simulation* simulation,
                               std::uint64_t seed, Diagnostics& diagnostics) {
    const model::GroupIndex groups(system);
    const auto source = groups.find(c.source), target = groups.find(c.target);
    const SynapseType* type = registry.synapse(model::synapse_of(c).type);
    if (!source.group || !target.group || !type) {
        diagnostics.error({}, fmt::format("connection '{}' is not complete", c.name));
        return {};
    }
    auto synapses =
        connectivity::connect(c, source.group->topology, target.group->topology, seed, diagnostics);
    auto strength = strengths(c, synapses, *type, simulation);
    return {std::move(synapses), std::move(strength)};
}

const model::Connection* find_connection(const model::System& system, std::string_view name,
                                         std::string_view option, Diagnostics& diagnostics, Location at) {
    const auto found = model::items_named(system.connections, name);
    if (found.size() == 1) return &system.connections[found.front()];
    std::vector<std::string> names, ids;
    for (const auto& c : system.connections) names.emplace_back(model::trim(c.name));
    for (const int i : found) ids.push_back(system.connections[i].id);
    if (found.empty())
        diagnostics.error(at, fmt::format("{}: there is no connection '{}'", option, name),
                          suggest(name, names));
    else
        diagnostics.error(at, fmt::format("{}: '{}' names {} connections", option, name, found.size()),
                          fmt::format("use the id: '{}'", separated(ids, "', '")));
    return nullptr;
}

void check_structure(const PlotSpec& spec, const model::System& system, std::string_view option,
                     Diagnostics& diagnostics, Location at) {
    if (spec.of_connection()) find_connection(system, spec.what, option, diagnostics, at);
    if (spec.kind != PlotSpec::Kind::diagram || spec.what.empty() || find_process(system, spec.what)) return;
    std::vector<std::string> names;
    for (const auto& p : system.processes) names.emplace_back(model::trim(p.name));
    diagnostics.error(at, fmt::format("{} '{}': there is no process '{}'", option, spec.text, spec.what),
                      suggest(spec.what, names));
}

WiringPlot wiring_of(const PlotSpec& spec, const model::System& system) {
    Diagnostics diagnostics;
    const auto* connection = find_connection(system, spec.what, "wiring", diagnostics);
    if (!connection) throw std::runtime_error(format(diagnostics));
    return groups_of(*connection, system);
}

Picture structure_plot(const PlotSpec& spec, const model::System& system, const Registry& registry,
                       const engine::Simulation* simulation, std::uint64_t seed, const std::string& run) {
    if (spec.of_connection()) {
        Diagnostics diagnostics;
        const auto* connection = find_connection(system, spec.what, "connection", diagnostics);
        if (!connection) throw std::runtime_error(format(diagnostics));
        return picture_of(*connection, spec.kind == PlotSpec::Kind::wiring, system, registry, simulation,
                          seed);
    }
    const auto* process = find_process(system, spec.what);
    return process ? process_diagram(system, *process) : diagram(system, run);
}

}  // namespace forage::plot
