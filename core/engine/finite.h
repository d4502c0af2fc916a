// Whether numbers are finite.
#pragma once

#include "core/base/column.h"

namespace forage::engine {

/// Of a row whose length is a multiple of eight, as rows of the arena are when they are filled up.
bool all_finite(const double* row, Index n);

}  // namespace forage::engine
