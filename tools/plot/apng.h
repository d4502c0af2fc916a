// Moving pictures.
#pragma once

#include <string>
#include <vector>

namespace forage::plot {

/// PNG files of one size and pixel format, joined to an animated PNG that shows each for `seconds` and
/// repeats for ever (PNG 3rd edition, section 11.3.6: acTL, fcTL, fdAT). Throws std::runtime_error when one
/// is no PNG or of another size.
std::string animated_png(const std::vector<std::string>& frames, double seconds);

}  // namespace forage::plot
