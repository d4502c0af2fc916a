// Neuron and synapse types that a system declares by equations.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::equations {

/// Makes the types that a system declares known, in place of those that another one has declared. Reports
/// mistakes in them; a type with mistakes is added, too, so that what uses it is checked.
void add_types(const model::System& system, Registry& registry, Diagnostics& diagnostics);

/// The place of a byte of a type's equations, whose pieces have a line break between them.
Location place(const model::TypeDeclaration& type, std::size_t at);

/// A line of a type's equations, as written.
struct EquationLine {
    std::string text;
    int line = 0;                       ///< in the file
    std::vector<std::string> computes;  ///< the names of what it assigns, each once
};
std::vector<EquationLine> lines(const model::TypeDeclaration& type);

}  // namespace forage::equations
