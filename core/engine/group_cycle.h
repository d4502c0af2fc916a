// One group's part of a cycle, and what of it need not be done again.
//
// Much of a system stands still most of the time: displays of a layer that is closed, senses that see
// nothing, a constant. Three facts, each kept per group, let such parts cost nothing and change no bit:
//
// - changed: the last cycle whose activity differed from that of the cycle before.
// - same_input: what the next update reads is what the last one read; no source has changed, no module wrote.
// - rests: the last update left every state as it was and asked for neither time nor random numbers, so that
//   with the same input the next one would too.
//
// A group that rests and keeps its input is neither updated nor delivered to. Who changes something from
// outside (an activity, a parameter) must say so: touch().
#pragma once

#include "core/engine/plan.h"

namespace forage::engine {

/// A group's state in `cycle`.
inline double* state_row(const GroupPlan& g, std::size_t state, std::uint64_t cycle) {
    const auto& s = g.states[state];
    if (s.depth == 1) return s.ring;  // saves a division for every connection
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * g.stride;
}

/// A group's activity in `cycle`.
inline double* activity_row(const GroupPlan& g, std::uint64_t cycle) {
    return state_row(g, static_cast<std::size_t>(g.output), cycle);
}

/// What an update works with besides the group.
struct UpdateFrame {
    std::uint64_t cycle;
    double *scratch, *before;  ///< the thread's
    bool watched;              ///< notes whether the states are finite
};

/// Updates the states, unless the group rests.
void update(GroupPlan& group, const UpdateFrame& frame);

/// The same in parts: begin_update(); when `in_parts` is set after it, update_part() for each of
/// `group.parts`, by several threads at once, and end_update(); otherwise update().
void begin_update(GroupPlan& group);
void update_part(GroupPlan& group, int part, const UpdateFrame& frame);
void end_update(GroupPlan& group, const UpdateFrame& frame);

/// How many numbers `before` must hold for a group.
std::size_t compared_numbers(const GroupPlan& group);

/// Notes which outputs of a module differ from what it wrote before.
void note_changes(ModulePlan& module);

/// Delivers what modules have written; before the first cycle.
void receive_from_modules(Plan& plan, GroupPlan& group);

/// Keeps a group's activity of `cycle` for the connections with a delay.
void remember(const GroupPlan& group, std::uint64_t cycle);

/// Delivers all that the group receives in the cycle after `cycle`; lets its synapses learn.
void deliver_to(Plan& plan, GroupPlan& group, std::uint64_t cycle);

/// The same in parts: begin_delivery(); when `receives` is set after it, prepare_part() for each of
/// `group.parts`, by several threads at once; then the incoming connections one after the other, by
/// add_part() for each part of one that divides(), by deliver_through() for others.
void begin_delivery(Plan& plan, GroupPlan& group, std::uint64_t cycle);
void prepare_part(Plan& plan, GroupPlan& group, int part, std::uint64_t cycle);
bool divides(const GroupPlan& group, const ConnectionPlan& connection);
void add_part(Plan& plan, GroupPlan& group, ConnectionPlan& connection, int part, std::uint64_t cycle);
void deliver_through(Plan& plan, GroupPlan& group, ConnectionPlan& connection, std::uint64_t cycle);

/// Sets `delivery_cost` of all groups.
void estimate_deliveries(Plan& plan);

/// About how long the phases of the next cycle take on one thread, ns.
double update_cost(const Plan& plan);
double delivery_cost(const Plan& plan);

/// The group was changed from outside: nothing that is known of it holds any longer.
void touch(GroupPlan& group, std::uint64_t cycle);

}  // namespace forage::engine
