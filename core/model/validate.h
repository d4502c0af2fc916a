// Checks a system against the types, before any connection is built.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// Reports duplicate ids; unknown types, parameters and states (with a guess of what is meant); values that
/// are invalid or outside their range; cross references that are unset or refer to nothing; groups of the
/// wrong size; connections between groups that do not exist, of a kind that the target does not read, or to
/// a group to which a module writes, too.
/// Modules check themselves against `environment`, which may be null.
void validate(const System& system, const Registry& registry, Diagnostics& diagnostics,
              Environment* environment = nullptr);

/// Reports a time constant (s) that is not positive, or too short for cycles of `dt` s.
void check_time_constant(const std::string& name, std::string_view doc, double tau, double dt,
                         const Location& at, Diagnostics& diagnostics);

/// Sets the parameters of `object`, an instance of a type with `parameters`, from `settings`. Parameters
/// without a setting keep their defaults, and values that validate() reports are ignored. A relative path
/// starts at the folder of the file that contains it.
void apply(const TypeUse& use, const std::vector<Parameter>& parameters, void* object);

}  // namespace forage::model
