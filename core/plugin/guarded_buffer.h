// A buffer that detects writes beyond its ends.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/base/column.h"

namespace forage::plugin {

/// Zeros with a margin on both sides that shows whether it was written to.
class GuardedBuffer {
  public:
    explicit GuardedBuffer(Index size)
        : all_(static_cast<std::size_t>(size + 2 * margin), std::bit_cast<double>(untouched)) {
        std::fill_n(data(), size, 0.0);
    }
    double* data() { return all_.data() + margin; }
    bool intact() const {
        const auto same = [](double v) { return std::bit_cast<std::uint64_t>(v) == untouched; };
        return std::all_of(all_.begin(), all_.begin() + margin, same) &&
               std::all_of(all_.end() - margin, all_.end(), same);
    }

  private:
    static constexpr Index margin = 64;  ///< numbers
    static constexpr std::uint64_t untouched =
        0x7ff8'f0a6'e0b5'1d37;  ///< a number that no type writes by chance
    std::vector<double> all_;
};

}  // namespace forage::plugin
