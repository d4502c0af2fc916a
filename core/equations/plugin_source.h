// A declared type as the source of a plugin.
#pragma once

#include <string>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::equations {

/// The C++ source of a plugin that computes what a declared type does, to the bit. `registry` has the type.
/// Throws FormulaError for what plugins cannot do, with the place in the equations.
std::string plugin_source(const model::TypeDeclaration& type, bool synapse, const Registry& registry);

}  // namespace forage::equations
