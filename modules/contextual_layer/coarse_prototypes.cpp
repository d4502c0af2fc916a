#include "modules/contextual_layer/coarse_prototypes.h"

#include <algorithm>

#include "core/base/simd.h"

namespace forage::contextual {
namespace {

/// distances[b lanes + l] = unit times the sum of |stored_b[i][l] - present[i]| over the `count` listed cells
/// i, for two blocks b. Sums are below 2^16, differences below 2^15.
FORAGE_SIMD void estimate_two(const std::int16_t* first, const std::int16_t* second, const Index* listed,
                              Index count, const std::int16_t* present, float unit, float* distances) {
    std::uint16_t total[2 * lanes];
    std::fill_n(total, 2 * lanes, std::uint16_t{0});
    for (Index k = 0; k < count; ++k)
#pragma GCC unroll 2
        for (Index b = 0; b < 2; ++b) {
            const std::int16_t* stored = (b ? second : first) + listed[k] * lanes;
            const std::int16_t here = present[listed[k]];
            for (Index l = 0; l < lanes; ++l) {
                const auto difference = static_cast<std::int16_t>(stored[l] - here);
                const auto size = static_cast<std::int16_t>(difference < 0 ? -difference : difference);
                total[b * lanes + l] =
                    static_cast<std::uint16_t>(total[b * lanes + l] + static_cast<std::uint16_t>(size));
            }
        }
    for (Index l = 0; l < 2 * lanes; ++l) distances[l] = static_cast<float>(total[l]) * unit;
}

}  // namespace

CoarsePrototypes::CoarsePrototypes(Index blocks, Index cells)
    : cells_(cells), levels_(static_cast<int>(std::min<Index>(32767, 65535 / std::max<Index>(1, cells)))) {
    if (!useful()) return;
    // The error is half a level for each of the two prototypes, the rounding errors of a sum of `cells`
    // numbers, and a few rounding errors of distances, collectors, shares and thresholds, for
    // refine_candidates().
    error_ = 1.0F / static_cast<float>(levels_) + static_cast<float>(cells + 16) * 0x1p-23F;
    blocks_.resize(static_cast<std::size_t>(blocks * cells * lanes), 0);
    present_.resize(static_cast<std::size_t>(cells), 0);
}

void CoarsePrototypes::compare_with(const Eigen::Ref<const Eigen::ArrayXd>& present) {
    for (Index i = 0; i < cells_; ++i) present_[static_cast<std::size_t>(i)] = level(present[i]);
}

void CoarsePrototypes::estimate(Index first, Index second, const CellList& cells, float* distances) const {
    const float unit = 1.0F / static_cast<float>(cells_ * levels_);
    const std::int16_t* const all = blocks_.data();
    estimate_two(all + first * cells_ * lanes, all + second * cells_ * lanes, cells.begin(), cells.size(),
                 present_.data(), unit, distances);
}

}  // namespace forage::contextual
