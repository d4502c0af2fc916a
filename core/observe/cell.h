// Cells of a group by the column and row that users give.
#pragma once

#include <optional>
#include <string_view>

#include "core/engine/plan/layout.h"

namespace forage::observe {

/// The cell in column `x` and row `y`, which count from 1 at the upper left. Reports one that is not there,
/// and every one of a sparse group; `what` says where the text stands ("--clamp").
std::optional<Index> find_cell(const engine::Layout& layout, int group, int x, int y, std::string_view what,
                               Diagnostics& diagnostics, Location at = {});

/// Reads "x,y".
std::optional<std::pair<int, int>> parse_cell(std::string_view text);

}  // namespace forage::observe
