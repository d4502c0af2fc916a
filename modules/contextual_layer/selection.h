// The selection of segments, and the action that they determine.
#pragma once

#include "modules/contextual_layer/long_term_memory.h"

namespace forage::contextual {

/// Selects the used segments whose collector c is above `threshold` and at least `share` times the largest
/// collector (or 0 if no collector is above 0). The triggers of selected segments become 1. Then the trigger
/// of each segment that follows a selected one, which is one step nearer to the goal, becomes
/// `trigger_reset`, which favours it from the next update on.
void select(LongTermMemory& memory, float threshold, float share, float trigger_reset);

/// out_m = sum of a_m c / (j + 1) over the selected segments in column j, added row by row in single
/// precision. `out` has M cells.
void sum_actions(const LongTermMemory& memory, Eigen::Ref<Eigen::ArrayXf> out);

}  // namespace forage::contextual
