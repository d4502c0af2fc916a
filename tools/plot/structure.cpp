#include "tools/plot/structure.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/connectivity/grid.h"
#include "core/model/find_one.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "tools/plot/connection.h"
#include "tools/plot/diagram.h"
#include "tools/plot/wiring.h"

namespace forage::plot {
namespace {

/// The process or connection with this name. Reports a name that none or several have.
template <class Item>
const Item* find(const std::vector<Item>& items, std::string_view kind, std::string_view name,
                 const std::string& context, Diagnostics& diagnostics, const Location& at) {
    const auto found =
        model::find_one(items, kind, name, [&](const std::string& message, const std::string& hint) {
            diagnostics.error(at, fmt::format("{}: {}", context, message), hint);
        });
    return found ? &items[static_cast<std::size_t>(*found)] : nullptr;
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
    return find(system.connections, "connection", name, std::string(option), diagnostics, at);
}

void check_structure(const PlotSpec& spec, const model::System& system, std::string_view option,
                     Diagnostics& diagnostics, Location at) {
    if (spec.of_connection()) find_connection(system, spec.what, option, diagnostics, at);
    if (spec.kind == PlotSpec::Kind::diagram && !spec.what.empty())
        find(system.processes, "process", spec.what, fmt::format("{} '{}'", option, spec.text), diagnostics,
             at);
}

WiringPlot wiring_of(const PlotSpec& spec, const model::System& system) {
    Diagnostics diagnostics;
    const auto* connection = find_connection(system, spec.what, "wiring", diagnostics);
    if (!connection) throw std::runtime_error(format(diagnostics));
    return groups_of(*connection, system);
}

Picture structure_plot(const PlotSpec& spec, const model::System& system, const Registry& registry,
                       const engine::Simulation* simulation, std::uint64_t seed, const std::string& run) {
    if (!spec.of_connection() && spec.what.empty()) return diagram(system, run);
    Diagnostics diagnostics;
    if (!spec.of_connection()) {
        const auto* process = find(system.processes, "process", spec.what, "diagram", diagnostics, {});
        if (!process) throw std::runtime_error(format(diagnostics));
        return process_diagram(system, *process);
    }
    const auto* connection = find_connection(system, spec.what, "connection", diagnostics);
    if (!connection) throw std::runtime_error(format(diagnostics));
    return picture_of(*connection, spec.kind == PlotSpec::Kind::wiring, system, registry, simulation, seed);
}

}  // namespace forage::plot
