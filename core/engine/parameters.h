// Changes parameters while a system runs.
#pragma once

#include <span>

#include "core/engine/cycle.h"
#include "core/model/edit.h"

namespace forage::engine {

/// Reports what set_parameter() would refuse, and what the types find wrong when the changes are made in this
/// order. It changes nothing itself.
void check_changes(const Plan& plan, const State& state, std::span<const model::Assignment> changes,
                   Diagnostics& diagnostics);

/// Changes a parameter. Throws RunError for a parameter that cannot change while the system runs.
void set_parameter(const Plan& plan, State& state, Cycle& cycle, const model::Assignment& change);

/// Returns the present value of a parameter.
ParameterValue parameter(const Plan& plan, const State& state, const model::Assignment& which);

}  // namespace forage::engine
