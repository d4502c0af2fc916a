// Where the numbers of a run stand in one block of memory.
#pragma once

#include <cstddef>

#include "core/base/column.h"

namespace forage::engine {

/// Hands out rows of numbers. Each row starts at a multiple of 64 bytes and is filled up with zeros.
class Rows {
  public:
    using Offset = std::size_t;  ///< from the start of the block, in numbers

    /// Returns the distance between two rows of `cells` numbers.
    static Index stride(Index cells) { return (cells + 7) / 8 * 8; }

    /// Reserves `rows` rows of `cells` numbers each, stride(cells) apart, and returns where they begin.
    Offset reserve(Index cells, std::int64_t rows = 1) {
        const Offset offset = size_;
        size_ += static_cast<std::size_t>(stride(cells) * rows);
        return offset;
    }
    std::size_t size() const { return size_; }

  private:
    std::size_t size_ = 0;
};

}  // namespace forage::engine
