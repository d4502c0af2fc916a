// One block of numbers that holds everything that changes during a run.
#pragma once

#include <cstddef>

#include "core/base/column.h"
#include "core/base/huge_pages.h"

namespace forage::engine {

/// Rows of doubles in one zeroed block. Each row starts at a multiple of 64 bytes. Reserve first, allocate
/// once.
class Arena {
  public:
    using Offset = std::size_t;

    /// Room for `rows` rows of `cells` numbers each, stride(cells) apart.
    Offset reserve(Index cells, Index rows = 1) {
        const Offset offset = size_;
        size_ += static_cast<std::size_t>(stride(cells) * rows);
        return offset;
    }
    void allocate() { block_.resize(size_); }
    double* at(Offset offset) { return block_.data() + offset; }
    double* data() { return block_.data(); }    ///< all of it
    std::size_t size() const { return size_; }  ///< in doubles

    /// Distance between two rows of `cells` numbers.
    static Index stride(Index cells) { return (cells + 7) / 8 * 8; }

  private:
    HugeVector<double> block_;
    std::size_t size_ = 0;
};

}  // namespace forage::engine
