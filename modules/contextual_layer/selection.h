// Which remembered segments speak, and what they say.
#pragma once

#include "modules/contextual_layer/long_term_memory.h"

namespace forage::contextual {

/// Selects the live segments whose collector c is > `threshold` and >= `share` times the largest collector (0
/// if none is above 0). A selected segment's trigger becomes 1; then that of the segment that followed it,
/// one nearer to the goal, becomes `trigger_reset`, so that it is favoured from the next update on.
void select(LongTermMemory& memory, float threshold, float share, float trigger_reset);

/// out_m = sum of a_m c / (j + 1) over the selected segments, j + 1 being their distance to the goal in
/// segments; by rows, then columns, in single precision. `out` has M cells.
void sum_actions(const LongTermMemory& memory, Eigen::Ref<Eigen::ArrayXf> out);

}  // namespace forage::contextual
