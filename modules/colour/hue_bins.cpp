#include "modules/colour/hue_bins.h"

#include <bit>
#include <cstdint>

namespace forage::colour {

HueBins::HueBins(Index bins) {
    const double half = 0.5 / static_cast<double>(bins);
    above_.push_back(static_cast<float>(1 - half));
    up_to_.push_back(static_cast<float>(half));
    for (Index b = 1; b < bins; ++b) {
        const double centre = static_cast<float>(b) / static_cast<float>(bins);
        above_.push_back(static_cast<float>(centre - half));
        up_to_.push_back(static_cast<float>(centre + half));
    }
}

bool HueBins::contains(Index bin, double hue) const {
    const auto b = static_cast<std::size_t>(bin);
    return bin == 0 ? hue > above_[0] || hue <= up_to_[0] : hue > above_[b] && hue <= up_to_[b];
}

void HueBins::separate(const Eigen::Ref<const Eigen::ArrayXd>& hue,
                       const Eigen::Ref<const Eigen::ArrayXd>& value,
                       Eigen::Ref<Eigen::ArrayXd> planes) const {
    const Index pixels = hue.size();
    const auto count = static_cast<double>(bins());
    const double near = 1e-6 * count;  // bins; more than the rounding errors of the limits
    planes.setZero();
    for (Index i = 0; i < pixels; ++i) {
        if (std::bit_cast<std::uint64_t>(value[i]) == 0) continue;  // most pixels have no colour
        if (hue[i] >= 0 && hue[i] <= 1) {
            const double position = hue[i] * count + 0.5;  // bin b is b..b+1, apart from rounding errors
            const auto bin = static_cast<Index>(position);
            const double inside = position - static_cast<double>(bin);
            if (inside > near && inside < 1 - near) {
                planes[(bin < bins() ? bin : 0) * pixels + i] = value[i];
                continue;
            }
        }
        for (Index b = 0; b < bins(); ++b)
            if (contains(b, hue[i])) planes[b * pixels + i] = value[i];
    }
}

}  // namespace forage::colour
