#include "core/engine/finite.h"

#include "core/base/simd.h"

namespace forage::engine {

/// x - x is 0, or NaN when x is NaN or infinite.
FORAGE_SIMD bool all_finite(const double* row, Index n) {
    constexpr Index lanes = 8;
    double sums[2 * lanes] = {};  // an addition waits for the one before
    Index i = 0;
    for (; i + 2 * lanes <= n; i += 2 * lanes)
        for (Index k = 0; k < 2 * lanes; ++k) sums[k] += row[i + k] - row[i + k];
    for (; i < n; i += lanes)
        for (Index k = 0; k < lanes; ++k) sums[k] += row[i + k] - row[i + k];
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum == 0;
}

}  // namespace forage::engine
