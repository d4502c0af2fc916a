// Windows summed column by column: what is read of the source serves several target rows.
#pragma once

#include "core/base/column.h"

namespace forage::engine {

/// Taps below each other, which are summed one after the other.
struct TapColumn {
    static constexpr Index least = 3;  ///< taps
    const double* source;              ///< what target cell 0 reads with the first tap
    const double* factors;             ///< of the taps, from the top down
    Index taps;
};

/// target[y * width + x] += the sum over all taps, from 0 and in order, of the source times the tap's factor;
/// for rows first_row to last_row - 1. The source's rows are `stride` numbers apart, and readable for 3
/// numbers more than the taps need. `scaled`: the factors are in the source already.
void add_columns(const TapColumn* columns, std::size_t count, bool scaled, Index width, Index first_row,
                 Index last_row, Index stride, double* target);

}  // namespace forage::engine
