// Normal numbers from a table.
#pragma once

#include <span>

namespace forage::bug {

/// The quantiles (i + 1/2) / 65536 of the standard normal distribution, i = 0..65535. A uniform 16-bit number
/// looks up a normal number between -4.32 and 4.32: the distribution is exact to 1/65536 in probability, and
/// a lookup costs a tenth of a logarithm, a root and a cosine. Good for noise that is rounded to 8 bits
/// afterwards.
std::span<const float> normal_quantiles();

}  // namespace forage::bug
