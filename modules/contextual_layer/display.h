// Pictures of the memory, NS x NL cells: segment (row l, column j) at cell l NS + j.
#pragma once

#include "modules/contextual_layer/contextual_layer.h"

namespace forage::contextual {

using Cells = Eigen::Map<Eigen::ArrayXd>;

/// Shows one number per segment in the first NL NS cells. Unless it is `whole`, only what the last step may
/// have changed is written: the live segments, and the sequence that it stored.
void show(const ContextualLayer& layer, const SegmentArray& numbers, bool whole, Cells cells);

/// Shows 1 for unused segments and 0 for live ones.
void show_empty(const ContextualLayer& layer, bool whole, Cells cells);

}  // namespace forage::contextual
