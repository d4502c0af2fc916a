#include "bug_interface/simulation/heights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace forage::bug {
namespace {

constexpr double same = 1e-6;       ///< m
constexpr double at_least = 0.001;  ///< m, that things must share to touch

}  // namespace

int Heights::layer(double low, double high, const Location& where, Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        if (std::abs(ranges_[i].first - low) < same && std::abs(ranges_[i].second - high) < same)
            return static_cast<int>(i);
    if (ranges_.size() == most_layers) {
        if (!too_many_)
            diagnostics.error(
                where,
                fmt::format("robots and loose things have more than {} different heights of shapes: "
                            "{:g} to {:g} m is one too many",
                            most_layers, low, high),
                "let shapes begin and end at the same heights");
        too_many_ = true;
        return 0;
    }
    ranges_.emplace_back(low, high);
    return static_cast<int>(ranges_.size()) - 1;
}

std::vector<LayerMask> Heights::meets() const {
    std::vector<LayerMask> out(ranges_.size(), 0);
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        for (std::size_t j = 0; j < ranges_.size(); ++j)
            if (std::min(ranges_[i].second, ranges_[j].second) -
                    std::max(ranges_[i].first, ranges_[j].first) >=
                at_least)
                out[i] |= LayerMask{1} << j;
    return out;
}

}  // namespace forage::bug
