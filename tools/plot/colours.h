// The colour maps of pictures, which are perceptually uniform.
#pragma once

#include <array>
#include <cstddef>

namespace forage::plot {

struct Colour {
    double r, g, b;  ///< 0..1
};

inline constexpr Colour black{0, 0, 0}, white{1, 1, 1}, grey{0.45, 0.45, 0.45}, pale{0.88, 0.88, 0.88};

/// A colour from dark blue to yellow for 0..1, from nine samples of viridis by N. Smith and S. van der Walt
/// (CC0).
Colour sequential(double fraction);
/// A colour from blue over white to red for -1..1, for values of both signs, from five samples of RdBu by C.
/// Brewer.
Colour diverging(double value);
/// Colour number n modulo 10 for lines: those of Okabe and Ito (2008), which can be distinguished with all
/// types of colour vision, but with a darker yellow, followed by brown and grey.
Colour category(std::size_t n);

}  // namespace forage::plot
