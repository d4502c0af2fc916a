// Means of several runs, with their intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace forage {

/// A mean, and the interval that holds the true one with 95 % confidence (Student's t).
struct Estimate {
    double mean = 0, low = 0, high = 0;
    std::size_t count = 1;  ///< how many numbers it is made of
};
/// The estimate from independent numbers; empty when there are none. That of one number has no width.
std::optional<Estimate> estimate(const std::vector<double>& numbers);

/// The estimate of a probability from so many hits, with Wilson's interval, which stays within 0 and 1.
/// `count` is at least 1.
Estimate share(std::size_t hits, std::size_t count);

/// Half the width of such an interval, from the variance (n - 1) of `count` numbers, at least 2. Its bits do
/// not depend on the mathematical library, because it uses square roots only.
double half_width(double variance, std::size_t count);

}  // namespace forage
