// The targets of plastic synapses by source, beside each other.
#pragma once

#include <vector>

#include "core/engine/kernels/source_order.h"

namespace forage::engine {

/// Consecutive places of a column of numbers.
struct Stretch {
    Index place, size;
};

/// What some targets of a frame (SourceOrder::Frame) hold, copied into a column in their order. A place is a
/// target.
class TargetFrame {
  public:
    explicit TargetFrame(const SourceOrder& order);

    /// Of the sources, in order: where their targets are in their frame.
    const std::vector<Stretch>& sources() const { return sources_; }

    // `part` is a stretch of frame `frame`, and `places` begin with it.

    /// places <- cells
    void gather(std::size_t frame, Stretch part, const double* cells, double* places) const;
    /// cells <- places
    void scatter(std::size_t frame, Stretch part, const double* places, double* cells) const;
    /// cells += places
    void add(std::size_t frame, Stretch part, const double* places, double* cells) const;

  private:
    const int* targets(std::size_t frame, Stretch part) const { return &cells_[begin_[frame]] + part.place; }

    std::vector<int> cells_;  ///< target cells, of one frame after the other
    std::vector<std::size_t> begin_;
    std::vector<Stretch> sources_;
};

}  // namespace forage::engine
