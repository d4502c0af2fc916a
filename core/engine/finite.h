// Searches rows for numbers that are not finite.
#pragma once

#include "core/base/column.h"

namespace forage::engine {

/// Returns whether all numbers of a row are finite. `n` is a multiple of eight.
bool all_finite(const double* row, Index n);

}  // namespace forage::engine
