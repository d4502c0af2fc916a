// Colours of pictures: even steps of a value look like even steps.
#pragma once

#include <array>
#include <cstddef>

namespace forage::plot {

struct Colour {
    double r, g, b;  ///< 0..1
};

inline constexpr Colour black{0, 0, 0}, white{1, 1, 1}, grey{0.45, 0.45, 0.45}, pale{0.88, 0.88, 0.88};

/// Dark blue to yellow for 0..1: viridis of N. Smith and S. van der Walt (CC0), nine samples of it.
Colour sequential(double part);
/// Blue over white to red for -1..1, for values on both sides of zero: RdBu of C. Brewer, five samples of it.
Colour diverging(double part);
/// The n-th of ten colours for lines, then again from the first: those of Okabe and Ito (2008), which differ
/// for every kind of sight, with a darker yellow, then brown and grey.
Colour category(std::size_t n);

}  // namespace forage::plot
