#include "core/engine/group_cycle.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/engine/finite.h"
#include "core/engine/simulation.h"
#include "core/types/reason.h"
#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr auto excitatory = static_cast<std::size_t>(InputKind::excitatory);
constexpr Index compared_activity = 96;           ///< cells; of larger groups only silence is noticed
constexpr std::size_t compared_states = 1 << 20;  ///< numbers; a group with more of them is always updated

auto& at(auto& all, int index) { return all[static_cast<std::size_t>(index)]; }

bool equal(const double* a, const double* b, Index n) {  // bit by bit
    return std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof *a) == 0;
}

/// Of a row that is filled up with zeros to a multiple of eight numbers. An active group shows early.
bool all_zero(const double* row, Index n) {
    constexpr Index lanes = 8;
    for (Index i = 0; i < n; i += lanes) {
        std::uint64_t bits = 0;
        for (Index k = 0; k < lanes; ++k) bits |= std::bit_cast<std::uint64_t>(row[i + k]);
        if (bits) return false;
    }
    return true;
}

/// Calls visit(row) for all rows of all states.
template <class Visit>
void each_row(const GroupPlan& g, Visit visit) {
    for (const auto& s : g.states)
        for (std::int64_t row = 0; row < s.depth; ++row) visit(s.ring + row * g.stride);
}

std::size_t state_numbers(const GroupPlan& g) {
    std::size_t rows = 0;
    for (const auto& s : g.states) rows += static_cast<std::size_t>(s.depth);
    return rows * static_cast<std::size_t>(g.stride);
}

/// A sum from 0, which turns -0 into 0.
FORAGE_SIMD void begin_sum(const double* from, Index n, double* to) {
    for (Index i = 0; i < n; ++i) to[i] = 0.0 + from[i];
}

/// Whether the states are what they were, and what they are in every cycle that is kept.
bool at_rest(const GroupPlan& g, const double* before) {
    for (const auto& s : g.states)
        for (std::int64_t row = 0; row < s.depth; ++row, before += g.stride)
            if (!equal(s.ring + row * g.stride, before, g.cells) || !equal(s.ring, before, g.cells))
                return false;
    return true;
}

/// Whether all that is delivered to a group is what was delivered in the cycle before.
bool receives_the_same(Plan& plan, const GroupPlan& g, std::uint64_t cycle) {
    for (const auto& [module, port] : g.module_inputs)
        if (at(plan.modules, module).changed[static_cast<std::size_t>(port)]) return false;
    for (const int i : g.incoming) {
        const auto& c = at(plan.connections, i);
        if (!c.effective) continue;
        if (c.plastic || c.changed) return false;
        if (at(plan.groups, c.source).changed >= static_cast<std::int64_t>(cycle) - c.longest_delay)
            return false;
    }
    return true;
}

void deliver_in_parts(Kernel& kernel, const History& history, double* target, ThreadPool& pool) {
    const int parts = 2 * pool.threads();
    auto prepare = [&](int part, int) { kernel.prepare(history, part, parts); };
    pool.run(parts, prepare);
    auto add = [&](int part, int) { kernel.add(history, target, part, parts); };
    pool.run(parts, add);
}

void run(Plan& plan, ConnectionPlan& c, std::uint64_t cycle, double* target, ThreadPool* pool) {
    const auto& source = at(plan.groups, c.source);
    const History history{
        activity_row(source, cycle), {source.history_ring, source.history + 1, source.stride}, cycle};
    try {
        if (target && pool && c.kernel->divides())
            deliver_in_parts(*c.kernel, history, target, *pool);
        else if (target)
            c.kernel->deliver(history, target);
        else
            c.plastic->learn(history);
    } catch (...) {
        throw RunError(fmt::format("{} of connection '{}' failed in cycle {}: {}", c.type.name, c.name, cycle,
                                   reason()));
    }
}

}  // namespace

double* state_row(const GroupPlan& g, std::size_t state, std::uint64_t cycle) {
    const auto& s = g.states[state];
    if (s.depth == 1) return s.ring;  // saves a division for every connection
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * g.stride;
}

double* activity_row(const GroupPlan& g, std::uint64_t cycle) {
    return state_row(g, static_cast<std::size_t>(g.output), cycle);
}

std::size_t compared_numbers(const GroupPlan& g) {
    const std::size_t numbers = state_numbers(g);
    return (numbers <= compared_states ? numbers : 0) + static_cast<std::size_t>(g.stride);
}

void update(GroupPlan& g, std::uint64_t cycle, double* scratch, double* before, bool watched) {
    if (g.rests) return;
    if (g.delivered) g.row ^= 1;
    g.delivered = false;
    // Looking for rest costs about as much as an update: after 1, 2, 4, 8... cycles with the same input.
    g.same_for = g.same_input ? g.same_for + 1 : 0;
    const bool look = std::has_single_bit(g.same_for) && state_numbers(g) <= compared_states;
    double* old = before;
    if (look) each_row(g, [&](const double* row) { old = std::copy_n(row, g.stride, old); });
    const bool small = g.cells <= compared_activity;
    if (small && cycle > 0) std::copy_n(activity_row(g, cycle - 1), g.cells, old);

    NeuronColumns columns(g.cells, g.stride, cycle,
                          {g.inputs[0][g.row], g.inputs[1][g.row], g.inputs[2][g.row]}, g.states, &g.random,
                          scratch, {!g.fed[0], !g.fed[1], !g.fed[2]});
    try {
        g.neuron->update(columns);
    } catch (...) {
        throw RunError(
            fmt::format("{} of group '{}' failed in cycle {}: {}", g.type.name, g.path, cycle, reason()));
    }
    // All rows follow each other, filled up with zeros; an older one that is not finite was found before.
    if (watched) g.finite = all_finite(g.states.front().ring, static_cast<Index>(state_numbers(g)));
    g.rests = look && columns.timeless() && at_rest(g, before);
    if (g.rests) return;
    const double* now = activity_row(g, cycle);
    if (small) {
        if (cycle == 0 || !equal(now, old, g.cells)) g.changed = static_cast<std::int64_t>(cycle);
    } else {
        const bool was_silent = std::exchange(g.silent, all_zero(now, g.cells));
        if (!(was_silent && g.silent)) g.changed = static_cast<std::int64_t>(cycle);
    }
}

void note_changes(ModulePlan& m) {
    for (std::size_t i = 0; i < m.out.size(); ++i) {
        m.changed[i] = m.written[i];
        m.ever_written[i] |= m.written[i];
        m.written[i] = 0;
        const Column& out = m.out[i];
        if (!m.changed[i] || out.size() > ModulePlan::compared_output) continue;
        auto& last = m.last[i];
        if (equal(last.data(), out.data(), out.size()))
            m.changed[i] = 0;
        else
            last = out;
    }
}

void remember(const GroupPlan& g, std::uint64_t cycle) {
    if (g.history == 0 || static_cast<std::int64_t>(cycle) > g.changed + g.history) return;
    const auto row = static_cast<Index>(cycle % static_cast<std::uint64_t>(g.history + 1));
    std::copy_n(activity_row(g, cycle), g.cells, g.history_ring + row * g.stride);
}

void receive_from_modules(Plan& plan, GroupPlan& g) {
    g.delivered = true;
    bool first = true;
    for (const auto& [module, port] : g.module_inputs) {
        double* row = g.inputs[excitatory][g.row ^ 1];
        const double* out = at(plan.modules, module).out[static_cast<std::size_t>(port)].data();
        if (std::exchange(first, false))
            begin_sum(out, g.cells, row);
        else
            Column(row, g.cells) += ConstColumn(out, g.cells);
    }
}

void deliver_to(Plan& plan, GroupPlan& g, std::uint64_t cycle, ThreadPool* pool) {
    g.same_input = receives_the_same(plan, g, cycle);
    if (!g.same_input) g.rests = false;
    const bool skip = g.rests && g.delivered;
    const std::size_t next = g.row ^ 1;
    if (!skip) {
        for (std::size_t k = 0; k < input_kinds; ++k)
            if (g.fed[k] && !(k == excitatory && !g.module_inputs.empty()))
                std::fill_n(g.inputs[k][next], g.cells, 0.0);
        receive_from_modules(plan, g);
    }
    for (const int i : g.incoming) {
        auto& c = at(plan.connections, i);
        if (c.effective && !skip)
            run(plan, c, cycle, g.inputs[static_cast<std::size_t>(c.kind)][next], pool);
        else if (c.plastic)
            run(plan, c, cycle, nullptr, nullptr);
        c.changed = false;
    }
}

double update_cost(const Plan& plan) {
    double cost = 0;
    for (const int i : plan.updated)
        if (const auto& g = at(plan.groups, i); !g.rests) cost += static_cast<double>(g.cells);
    return cost;
}

double delivery_cost(const Plan& plan) {
    double cost = 0;
    for (const int i : plan.updated)
        if (const auto& g = at(plan.groups, i); !g.rests) cost += g.delivery_cost;
    return cost;
}

void touch(GroupPlan& g, std::uint64_t cycle) {
    g.rests = g.silent = false;
    g.same_for = 0;
    g.changed = static_cast<std::int64_t>(cycle);
}

}  // namespace forage::engine
