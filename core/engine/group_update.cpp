#include "core/engine/group_update.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/engine/finite.h"
#include "core/engine/group_cycle.h"
#include "core/engine/simulation.h"

namespace forage::engine {
namespace {

constexpr Index compared_activity = 96;           ///< cells; of larger groups only silence is noticed
constexpr std::size_t compared_states = 1 << 20;  ///< numbers; a group with more of them is always updated

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

/// Whether the states are what they were, and what they are in every cycle that is kept.
bool at_rest(const GroupPlan& g, const double* before) {
    for (const auto& s : g.states)
        for (std::int64_t row = 0; row < s.depth; ++row, before += g.stride)
            if (!same_bits(s.ring + row * g.stride, before, g.cells) || !same_bits(s.ring, before, g.cells))
                return false;
    return true;
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

/// Lets the type update a range of cells. Whether it was time_invariant.
bool update_cells(const GroupPlan& g, Index first, Index count, const UpdateFrame& f) {
    NeuronColumns columns(count, g.stride, f.cycle,
                          {g.inputs[0][g.row], g.inputs[1][g.row], g.inputs[2][g.row]}, g.states, &g.random,
                          f.scratch, {!g.fed[0], !g.fed[1], !g.fed[2]}, first);
    try {
        g.neuron->update(columns);
    } catch (...) {
        throw RunError(fmt::format("{} of group '{}' failed in cycle {}: {}", g.type.name, g.path, f.cycle,
                                   current_exception_message()));
    }
    return columns.time_invariant();
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
    const bool time_invariant = update_cells(g, 0, g.cells, f);
    // All rows follow each other, filled up with zeros; an older one that is not finite was found before.
    if (f.check_finite) g.finite = all_finite(g.states.front().ring, static_cast<Index>(state_numbers(g)));
    g.rests = look && time_invariant && at_rest(g, f.before);
    if (g.rests) return;
    const double* now = activity_row(g, f.cycle);
    if (!small)
        note_silence(g, all_zero(now, g.cells), f.cycle);
    else if (f.cycle == 0 || !same_bits(now, old, g.cells))
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
    auto& found = g.parts[static_cast<std::size_t>(part)];
    found = {true, true};
    if (count <= 0) return;
    update_cells(g, first, count, f);
    if (f.check_finite)
        each_row(g,
                 [&](const double* row) { found.finite &= all_finite(row + first, Arena::stride(count)); });
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

double update_cost(const Plan& plan) {
    double cost = 0;
    for (const int i : plan.updated)
        if (const auto& g = plan.groups[static_cast<std::size_t>(i)]; !g.rests)
            cost += static_cast<double>(g.cells);
    return cost;
}

}  // namespace forage::engine
