// Manipulations from their specifications: --clamp, --add and --multiply, and the elements of an experiment.
#pragma once

#include <memory>
#include <vector>

#include "core/model/expression.h"
#include "core/observe/clamp_times.h"

namespace forage::observe {

/// The manipulations of a system, in the order in which they are applied: clamps, additions, multiplications.
/// Within each kind, tables come before patterns. Specifications of cells of one group with equal settings
/// are joined to one pattern; the other cells of the group are 0 in a clamp, and unchanged otherwise.
/// `trials` says whether the run has trials. Reports unknown groups, cells and wrong values, clamps that set
/// a cell at the same time, and manipulations that can never act in a run of this length.
std::vector<std::unique_ptr<Manipulation>> make_manipulations(
    const std::vector<model::ManipulationSpec>& specs, const engine::Layout& layout, bool trials,
    Diagnostics& diagnostics, const KnownLength& length = {});

}  // namespace forage::observe
