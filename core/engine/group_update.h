// A group's update: all of it, or in parts by several threads.
#pragma once

#include "core/engine/plan/plan.h"

namespace forage::engine {

/// What an update works with besides the group.
struct UpdateFrame {
    std::uint64_t cycle;
    double *scratch, *before;  ///< the thread's
    bool check_finite;         ///< notes whether the states are finite
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

/// About how long all updates of the next cycle take on one thread, ns.
double update_cost(const Plan& plan);

}  // namespace forage::engine
