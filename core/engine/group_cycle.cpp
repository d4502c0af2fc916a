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

/// Calls `work` with the activity that a connection reads.
template <class Work>
void run(Plan& plan, const ConnectionPlan& c, std::uint64_t cycle, Work work) {
    const auto& source = at(plan.groups, c.source);
    const History history{
        activity_row(source, cycle), {source.history_ring, source.history + 1, source.stride}, cycle};
    try {
        work(history);
    } catch (...) {
        throw RunError(fmt::format("{} of connection '{}' failed in cycle {}: {}", c.type.name, c.name, cycle,
                                   reason()));
    }
}

/// What a connection adds to, for the next cycle.
double* target_row(const GroupPlan& g, const ConnectionPlan& c) {
    return g.inputs[static_cast<std::size_t>(c.kind)][g.row ^ 1];
}

/// The cells of a part: whole grains of random numbers, and of lines of the cache.
Range cells_of_part(const GroupPlan& g, int part) {
    constexpr auto grain = RandomStream::grain;
    const auto cells = static_cast<std::size_t>(g.cells);
    Range out((cells + grain - 1) / grain, part, static_cast<int>(g.parts.size()));
    out.first *= grain;
    out.last = std::min(out.last * grain, cells);
    return out;
}

/// Puts into the rows that receive what modules have written, for a range of cells.
void receive(Plan& plan, GroupPlan& g, Index first, Index count) {
    for (std::size_t k = 0; k < input_kinds; ++k)
        if (g.fed[k] && !(k == excitatory && !g.module_inputs.empty()))
            std::fill_n(g.inputs[k][g.row ^ 1] + first, count, 0.0);
    double* row = g.inputs[excitatory][g.row ^ 1] + first;
    bool sum = false;
    for (const auto& [module, port] : g.module_inputs) {
        const double* out = at(plan.modules, module).out[static_cast<std::size_t>(port)].data() + first;
        if (std::exchange(sum, true))
            Column(row, count) += ConstColumn(out, count);
        else
            begin_sum(out, count, row);
    }
}

std::uint64_t same_for_now(const GroupPlan& g) { return g.same_input ? g.same_for + 1 : 0; }

/// Whether this update looks if the group rests, which costs about as much as an update: after 1, 2, 4, 8...
/// cycles with the same input.
bool looks(const GroupPlan& g) {
    return std::has_single_bit(same_for_now(g)) && state_numbers(g) <= compared_states;
}

/// From here on `g.row` is the row of this update.
void begin(GroupPlan& g) {
    if (g.delivered) g.row ^= 1;
    g.delivered = false;
    g.same_for = same_for_now(g);
}

/// Lets the type update a range of cells. Whether it was timeless.
bool update_cells(const GroupPlan& g, Index first, Index count, const UpdateFrame& f) {
    NeuronColumns columns(count, g.stride, f.cycle,
                          {g.inputs[0][g.row], g.inputs[1][g.row], g.inputs[2][g.row]}, g.states, &g.random,
                          f.scratch, {!g.fed[0], !g.fed[1], !g.fed[2]}, first);
    try {
        g.neuron->update(columns);
    } catch (...) {
        throw RunError(
            fmt::format("{} of group '{}' failed in cycle {}: {}", g.type.name, g.path, f.cycle, reason()));
    }
    return columns.timeless();
}

/// Of a large group.
void note_silence(GroupPlan& g, bool silent, std::uint64_t cycle) {
    const bool was_silent = std::exchange(g.silent, silent);
    if (!(was_silent && silent)) g.changed = static_cast<std::int64_t>(cycle);
}

void update_whole(GroupPlan& g, const UpdateFrame& f, bool look) {
    double* old = f.before;
    if (look) each_row(g, [&](const double* row) { old = std::copy_n(row, g.stride, old); });
    const bool small = g.cells <= compared_activity;
    if (small && f.cycle > 0) std::copy_n(activity_row(g, f.cycle - 1), g.cells, old);
    const bool timeless = update_cells(g, 0, g.cells, f);
    // All rows follow each other, filled up with zeros; an older one that is not finite was found before.
    if (f.watched) g.finite = all_finite(g.states.front().ring, static_cast<Index>(state_numbers(g)));
    g.rests = look && timeless && at_rest(g, f.before);
    if (g.rests) return;
    const double* now = activity_row(g, f.cycle);
    if (!small)
        note_silence(g, all_zero(now, g.cells), f.cycle);
    else if (f.cycle == 0 || !equal(now, old, g.cells))
        g.changed = static_cast<std::int64_t>(f.cycle);
}

}  // namespace

std::size_t compared_numbers(const GroupPlan& g) {
    const std::size_t numbers = state_numbers(g);
    return (numbers <= compared_states ? numbers : 0) + static_cast<std::size_t>(g.stride);
}

void update(GroupPlan& g, const UpdateFrame& f) {
    if (g.rests) return;
    const bool look = looks(g);
    begin(g);
    update_whole(g, f, look);
}

void begin_update(GroupPlan& g) {
    g.in_parts = !g.rests && !looks(g);
    if (g.in_parts) begin(g);
}

void update_part(GroupPlan& g, int part, const UpdateFrame& f) {
    const Range cells = cells_of_part(g, part);
    const auto first = static_cast<Index>(cells.first), count = static_cast<Index>(cells.last) - first;
    auto& found = at(g.parts, part);
    found = {true, true};
    if (count <= 0) return;
    update_cells(g, first, count, f);
    if (f.watched) each_row(g, [&](const double* row) { found.finite &= all_finite(row + first, count); });
    found.silent = all_zero(activity_row(g, f.cycle) + first, count);
}

void end_update(GroupPlan& g, const UpdateFrame& f) {
    if (!g.in_parts) return;
    const auto all = [&](bool GroupPlan::Part::*flag) {
        return std::all_of(g.parts.begin(), g.parts.end(), [&](const auto& p) { return p.*flag; });
    };
    g.finite = all(&GroupPlan::Part::finite);
    note_silence(g, all(&GroupPlan::Part::silent), f.cycle);
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
    receive(plan, g, 0, g.cells);
}

void begin_delivery(Plan& plan, GroupPlan& g, std::uint64_t cycle) {
    g.same_input = receives_the_same(plan, g, cycle);
    if (!g.same_input) g.rests = false;
    g.receives = !(g.rests && g.delivered);
    g.delivered = true;
}

bool divides(const GroupPlan& g, const ConnectionPlan& c) {
    return g.receives && c.effective && c.kernel->divides();
}

void prepare_part(Plan& plan, GroupPlan& g, int part, std::uint64_t cycle) {
    const Range cells = cells_of_part(g, part);
    if (cells.first < cells.last)
        receive(plan, g, static_cast<Index>(cells.first), static_cast<Index>(cells.last - cells.first));
    for (const int i : g.incoming)
        if (auto& c = at(plan.connections, i); divides(g, c))
            run(plan, c, cycle,
                [&](const History& h) { c.kernel->prepare(h, part, static_cast<int>(g.parts.size())); });
}

void add_part(Plan& plan, GroupPlan& g, ConnectionPlan& c, int part, std::uint64_t cycle) {
    run(plan, c, cycle, [&](const History& h) {
        c.kernel->add(h, target_row(g, c), part, static_cast<int>(g.parts.size()));
    });
}

void deliver_through(Plan& plan, GroupPlan& g, ConnectionPlan& c, std::uint64_t cycle) {
    if (c.effective && g.receives)
        run(plan, c, cycle, [&](const History& h) { c.kernel->deliver(h, target_row(g, c)); });
    else if (c.plastic)
        run(plan, c, cycle, [&](const History& h) { c.plastic->learn(h); });
}

void deliver_to(Plan& plan, GroupPlan& g, std::uint64_t cycle) {
    begin_delivery(plan, g, cycle);
    if (g.receives) receive(plan, g, 0, g.cells);
    for (const int i : g.incoming) {
        auto& c = at(plan.connections, i);
        deliver_through(plan, g, c, cycle);
        c.changed = false;
    }
}

void estimate_deliveries(Plan& plan) {
    for (auto& g : plan.groups) {
        g.delivery_cost = 0;
        for (const int i : g.incoming) g.delivery_cost += at(plan.connections, i).kernel->cost();
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
