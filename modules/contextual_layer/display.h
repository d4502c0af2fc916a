// Pictures of the long-term memory: segment (row l, column j) is cell l NS + j of NS x NL cells.
#pragma once

#include "modules/contextual_layer/contextual_layer.h"

namespace forage::contextual {

using Cells = Eigen::Map<Eigen::ArrayXd>;

/// Writes one number per segment to the first NL NS cells. Unless `whole` is set, only the cells that the
/// last step may have changed are written: those of used segments and of the sequence that was stored.
void show(const ContextualLayer& layer, const SegmentArray& numbers, bool whole, Cells cells);

/// Writes 1 for unused segments and 0 for used ones, as show() does.
void show_empty(const ContextualLayer& layer, bool whole, Cells cells);

}  // namespace forage::contextual
