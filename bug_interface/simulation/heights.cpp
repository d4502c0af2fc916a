#include "bug_interface/simulation/heights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace forage::bug {
namespace {

constexpr double tolerance = 1e-6;    ///< m; ranges that differ by less are the same
constexpr double min_shared = 0.001;  ///< m; shapes that share less do not touch

}  // namespace

int Heights::layer(double low, double high, const Location& where, Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        if (std::abs(ranges_[i].first - low) < tolerance && std::abs(ranges_[i].second - high) < tolerance)
            return static_cast<int>(i);
    if (ranges_.size() == max_layers) {
        if (!too_many_)
            diagnostics.error(where,
                              fmt::format("the shapes of robots and movable objects have more than {} "
                                          "different ranges of heights: {:g} to {:g} m is one too many",
                                          max_layers, low, high),
                              "let shapes begin and end at the same heights");
        too_many_ = true;
        return 0;
    }
    ranges_.emplace_back(low, high);
    return static_cast<int>(ranges_.size()) - 1;
}

std::vector<LayerMask> Heights::collision_masks() const {
    std::vector<LayerMask> out(ranges_.size(), 0);
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        for (std::size_t j = 0; j < ranges_.size(); ++j)
            if (std::min(ranges_[i].second, ranges_[j].second) -
                    std::max(ranges_[i].first, ranges_[j].first) >=
                min_shared)
                out[i] |= LayerMask{1} << j;
    return out;
}

}  // namespace forage::bug
