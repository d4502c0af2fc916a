// A simulation that continues where one of a similar system was.
#pragma once

#include <set>
#include <string>

#include "core/engine/plan/plan.h"
#include "core/engine/state.h"

namespace forage::engine {

/// What two systems have in common, by id: groups of the same type and topology, modules (by the id of their
/// process) with the same ports, and connections with the same ends, pattern and type.
struct Unchanged {
    std::set<std::string, std::less<>> groups, modules, connections;
};

/// Copies the states of everything that is unchanged, what was delivered to it, and the number of cycles, so
/// that the random streams continue, too. Parameters are not copied. What is new begins with its initial
/// states; nothing has been delivered to it. Activity of the past that a longer delay needs and that was not
/// kept counts as 0. A module whose type does not declare its members starts from its initial state. Both
/// simulations must have started. Throws ArchiveError when a module rejects the archive; the state must then
/// be discarded.
void adopt(const Plan& plan, State& state, const Plan& old_plan, State& old_state,
           const Unchanged& unchanged);

}  // namespace forage::engine
