#include "core/run/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/model/find_one.h"
#include "core/model/lookup.h"

namespace forage {
namespace {

const engine::Layout::Connection& about(const Run& run, int connection) {
    return run.layout().connections[static_cast<std::size_t>(connection)];
}

std::size_t cells(const Run& run, int group) {
    return static_cast<std::size_t>(run.layout().groups[static_cast<std::size_t>(group)].shape.cells);
}

/// The synapses as the system describes them.
connectivity::Synapses described(const Run& run, int connection) {
    const auto& system = run.system();
    const auto& c = *std::ranges::find(system.connections, about(run, connection).id, &model::Connection::id);
    const model::GroupIndex groups(system);
    Diagnostics diagnostics;
    auto out = connectivity::connect(c, groups.find(c.source).group->topology,
                                     groups.find(c.target).group->topology, run.seed(), diagnostics);
    throw_errors(diagnostics);
    for (std::size_t i = 0; i < out.weight.size(); ++i) out.attenuation[i] = -out.weight[i];
    if (!out.weight.empty()) out.reference = 0;
    out.weight = {}, out.distance = {};
    return out;
}

/// The state that holds the weights. Throws InputError.
int weight_state(const Run& run, int connection) {
    const auto& [name, type] = std::tie(about(run, connection).name, about(run, connection).type);
    const auto found = std::ranges::find(type.states, "weight", &SynapseStateInfo::name);
    if (found == type.states.end())
        throw InputError(fmt::format(
            "the synapses of connection '{}' have no weights: {} has no state 'weight'", name, type.name));
    return static_cast<int>(found - type.states.begin());
}

}  // namespace

bool is_connection(const Run& run, std::string_view name) {
    return model::groups_named(run.layout().groups, name).empty() &&
           !model::items_named(run.layout().connections, name).empty();
}

int find_connection(const Run& run, std::string_view name) {
    return *model::find_one(
        run.layout().connections, "connection", name,
        [](const std::string& message, const std::string& hint) { throw InputError(message, hint); });
}

std::vector<double> weights(Run& run, int connection) {
    const auto& c = about(run, connection);
    run.start();
    if (!c.type.has_gain) {
        weight_state(run, connection);
        return run.read(c.id + ":weight");
    }
    const auto& own = run.simulation().replaced_synapses(connection);
    const auto all = own.size() > 0 ? own : described(run, connection);
    const std::size_t sources = cells(run, c.source);
    std::vector<double> out(cells(run, c.target) * sources, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < all.size(); ++i) {
        double& w =
            out[static_cast<std::size_t>(all.post[i]) * sources + static_cast<std::size_t>(all.pre[i])];
        w = (std::isnan(w) ? 0 : w) + (all.reference - all.attenuation[i]);
    }
    return out;
}

NewWeights check_weights(Run& run, int connection, std::span<const double> values) {
    const auto& c = about(run, connection);
    const std::size_t sources = cells(run, c.source), targets = cells(run, c.target);
    if (values.size() != targets * sources)
        throw InputError(fmt::format("the weights of connection '{}' are {} x {} numbers, not {}", c.name,
                                     targets, sources, values.size()),
                         "give a row per target cell, with a number per source cell");
    NewWeights out{connection, c.type.has_gain ? -1 : weight_state(run, connection), {}, {}};
    run.start();
    if (run.simulation().connection_form(connection) == "pruned")
        throw InputError(
            fmt::format("nothing that this run computes depends on connection '{}'", c.name),
            "demand its target before the first cycle, as an observer or when the run is opened");
    const auto& all = out.synapses = described(run, connection);
    const auto place = [&](std::size_t i) {
        return fmt::format("from cell {} to cell {} of connection '{}'", all.pre[i], all.post[i], c.name);
    };
    std::vector<char> taken(values.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t at =
            static_cast<std::size_t>(all.post[i]) * sources + static_cast<std::size_t>(all.pre[i]);
        if (std::exchange(taken[at], 1)) throw InputError("several synapses lead " + place(i));
        if (!std::isfinite(values[at]))
            throw InputError(fmt::format("the weight of the synapse {} is {}", place(i), values[at]),
                             "give a finite number for each synapse; cells count from 0");
        out.values.push_back(values[at]);
    }
    for (std::size_t at = 0; at < values.size(); ++at)
        if (!taken[at] && !std::isnan(values[at]))
            throw InputError(fmt::format("there is no synapse from cell {} to cell {} of connection '{}'",
                                         at % sources, at / sources, c.name),
                             "give NaN where there is none, as in the weights that are read");
    return out;
}

void set_weights(Run& run, NewWeights&& weights) {
    auto& [connection, state, synapses, values] = weights;
    if (state >= 0) return run.simulation().set_synapse_state(connection, state, values);
    for (std::size_t i = 0; i < values.size(); ++i) synapses.attenuation[i] = -values[i];
    synapses.reference = 0;
    run.simulation().replace_synapses(connection, std::move(synapses));
}

}  // namespace forage
