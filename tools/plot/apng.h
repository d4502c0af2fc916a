// Animated PNG files.
#pragma once

#include <string>
#include <vector>

namespace forage::plot {

/// Joins PNG files of the same size and pixel format to an animated PNG, which shows each of them for
/// `seconds` and repeats forever (PNG 3rd edition, section 11.3.6: acTL, fcTL, fdAT). `frames` are the
/// contents of the files. Throws std::runtime_error when one is not a PNG file or has another size.
std::string animated_png(const std::vector<std::string>& frames, double seconds);

}  // namespace forage::plot
