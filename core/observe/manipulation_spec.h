// What --clamp, --add and --multiply ask for, and the elements of these names in an experiment.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/experiment.h"
#include "core/observe/manipulation.h"

namespace forage::observe {

/// Reads "Process/Group(x,y)=value ..." or "Process/Group=FILE" with "; every N", "; step N", "; times N",
/// "; backwards", "; from WHEN", "; until WHEN" behind it. Throws std::invalid_argument that says what is
/// wrong.
model::ManipulationSpec parse_manipulation(model::ManipulationSpec::Mode mode, std::string_view text);

/// The manipulations of a system. Cells of one group with the same settings make one pattern; the cells that
/// it does not name are 0 in a clamp and stay as they are otherwise. Clamps come first, then what is added,
/// then what is multiplied. `trials`: whether the run has any. Reports what cannot be.
std::vector<std::unique_ptr<Manipulation>> make_manipulations(const std::vector<model::ManipulationSpec>& specs,
                                                              const engine::Layout& layout, bool trials,
                                                              Diagnostics& diagnostics);

/// The group whose activity a user means; -1 when there is none, which is reported. `what`: "--clamp".
int manipulated_group(const model::Expression& group, std::string_view what, const engine::Layout& layout,
                      Diagnostics& diagnostics);

}  // namespace forage::observe
