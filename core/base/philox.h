// Blocks of Philox4x32-10 for the random streams. Types do not use this header.
#pragma once

#include <cstdint>

#include <Random123/philox.h>

namespace forage::philox {

/// The values that all blocks of one draw share.
struct Draw {
    std::uint32_t key[2], cycle[2], draw;
};

inline Draw draw_of(std::uint64_t key, std::uint64_t cycle, std::uint32_t draw) {
    return {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)},
            {static_cast<std::uint32_t>(cycle), static_cast<std::uint32_t>(cycle >> 32)},
            draw};
}

/// Computes one block. `stream` separates different uses of one draw. Compilers vectorise a loop over
/// `index`.
inline r123::Philox4x32::ctr_type block(const Draw& d, std::uint32_t index, std::uint32_t stream) {
    return r123::Philox4x32{}({{index, d.cycle[0], d.cycle[1], d.draw | stream}}, {{d.key[0], d.key[1]}});
}

}  // namespace forage::philox
