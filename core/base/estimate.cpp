#include "core/base/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forage {
namespace {

/// The 97.5 % quantile of Student's t distribution.
double student(std::size_t degrees) {
    static constexpr std::array table = {12.706, 4.303, 3.182, 2.776, 2.571,
                                         2.447,  2.365, 2.306, 2.262, 2.228};
    if (degrees <= table.size()) return table[degrees - 1];
    // The first terms of its expansion around the normal quantile (Abramowitz and Stegun, 26.7.5); exact to 3
    // decimals.
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const double n = static_cast<double>(degrees);
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

}  // namespace

double half_width(double variance, std::size_t count) {
    return student(count - 1) * std::sqrt(variance / static_cast<double>(count));
}

std::optional<Estimate> estimate(const std::vector<double>& numbers) {
    if (numbers.empty()) return std::nullopt;
    const auto n = static_cast<double>(numbers.size());
    double mean = 0, squares = 0;
    for (const double v : numbers) mean += v / n;
    for (const double v : numbers) squares += (v - mean) * (v - mean);
    if (numbers.size() == 1) return Estimate{mean, mean, mean};
    const double half = half_width(squares / (n - 1), numbers.size());
    return Estimate{mean, mean - half, mean + half, numbers.size()};
}

Estimate share(std::size_t hits, std::size_t count) {
    constexpr double z = 1.959964;
    const auto n = static_cast<double>(count);
    const double p = static_cast<double>(hits) / n, scale = 1 + z * z / n;
    const double middle = (p + z * z / (2 * n)) / scale,
                 half = z / scale * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    return {p, std::max(middle - half, 0.0), std::min(middle + half, 1.0), count};
}

}  // namespace forage
