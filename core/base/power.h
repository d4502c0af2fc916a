// Powers in formulas and in the plugins that are written from them.
#pragma once

#include <cmath>

namespace forage {

/// The power `base`^`exponent`. Squares and cubes are products.
inline double power(double base, double exponent) {
    return exponent == 2 ? base * base : exponent == 3 ? base * base * base : std::pow(base, exponent);
}

}  // namespace forage
