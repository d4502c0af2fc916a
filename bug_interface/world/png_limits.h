// How much of a PNG file is read.
#pragma once

#include <cstdint>

namespace forage::bug {

inline constexpr std::uint64_t most_pixels = 4096 * 4096;  ///< a floor takes 4 bytes for each
/// Bytes. Texts and profiles stand there, packed up to a thousandfold; libpng's general reader unpacks all.
inline constexpr std::uint64_t most_before_pixels = 64 << 10;

}  // namespace forage::bug
