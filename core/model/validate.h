// Checks a system against the types: everything that can be said before any connection is built.
#pragma once

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// Reports into `diagnostics`: ids used twice, unknown types, parameters and states (with what was probably
/// meant), values that are none or outside their range, cross references that are unset or lead nowhere,
/// groups of the wrong size, connections between groups that do not exist or of a kind that the target does
/// not read. Modules check themselves against `environment`, which may be null.
void validate(const System& system, const Registry& registry, Diagnostics& diagnostics,
              Environment* environment = nullptr);

/// Sets the parameters of `object`, an instance of a type with `parameters`, from `settings`; what is not in
/// them is left at its default. Values that validate() reports are left out. A relative path leads from the
/// file that says it.
void apply(const std::vector<Setting>& settings, const std::vector<Parameter>& parameters, void* object);

}  // namespace forage::model
