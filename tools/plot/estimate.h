// Means of several runs, with their intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace forage::plot {

/// A mean, and the interval that holds the true one with 95 % confidence (Student's t).
struct Estimate {
    double mean = 0, low = 0, high = 0;
    std::size_t count = 1;  ///< how many numbers it is made of
};
/// The estimate from independent numbers; empty when there are none. That of one number has no width.
std::optional<Estimate> estimate(const std::vector<double>& numbers);

}  // namespace forage::plot
