#include "bug_interface/sensing/normal_table.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace forage::bug {
namespace {

std::vector<float> make_quantiles() {
    constexpr std::size_t size = 65536, half = size / 2;
    std::vector<float> table(size);
    double x = 0;
    for (std::size_t i = 0; i < half; ++i) {
        // Newton's method, starting at the previous quantile. The function is concave here, so that it does
        // not overshoot.
        const double tail = (static_cast<double>(half - i) - 0.5) / static_cast<double>(size);
        for (int step = 0; step < 20; ++step) {
            const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
            const double change = (std::erfc(x / std::numbers::sqrt2) / 2 - tail) / density;
            x += change;
            if (std::abs(change) < 1e-9) break;
        }
        table[half + i] = static_cast<float>(x);
        table[half - 1 - i] = static_cast<float>(-x);
    }
    return table;
}

}  // namespace

std::span<const float> normal_quantiles() {
    static const std::vector<float> table = make_quantiles();
    return table;
}

}  // namespace forage::bug
