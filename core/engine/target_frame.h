// The targets of plastic synapses by source, seen as a few columns of numbers.
#pragma once

#include <vector>

#include "core/engine/source_order.h"

namespace forage::engine {

/// What lies beside each other in a frame of targets (SourceOrder::Frame) is a place. A run of targets begins
/// at a multiple of `lanes` places, so that it is copied in whole vectors; the places that fill it up stand
/// for the targets behind it, and are never written back. Where runs are so short that this would be a waste,
/// every place is a target.
class TargetFrame {
  public:
    static constexpr Index lanes = 4;

    /// Some of a frame's targets.
    struct Part {
        std::size_t first, last;  ///< items; last: one past
    };

    explicit TargetFrame(const SourceOrder& order);

    /// Of the sources, in order: its targets, its first place in its frame, and how many places it has.
    struct Source {
        Part part;
        Index place, size;
    };
    const std::vector<Source>& sources() const { return sources_; }
    /// Calls visit(place, target) for all targets of the n-th source, counting places from its first one.
    template <class Visit>
    void each(std::size_t n, Visit visit) const {
        Index place = 0;
        for (std::size_t i = sources_[n].part.first; i < sources_[n].part.last; ++i) {
            if (runs_.empty())
                visit(place++, cells_[i]);
            else
                for (int k = 0; k < runs_[i].size; ++k) visit(place + k, runs_[i].target + k);
            if (!runs_.empty()) place += filled(runs_[i].size);
        }
    }

    // A row of cells has `lanes` more numbers than there are targets.

    /// places <- cells
    void gather(Part part, const double* cells, double* places) const;
    /// cells <- places
    void scatter(Part part, const double* places, double* cells) const;
    /// cells += places
    void add(Part part, const double* places, double* cells) const;

  private:
    static Index filled(int size) { return (size + lanes - 1) / lanes * lanes; }
    std::vector<Run> runs_;   ///< the items, or empty:
    std::vector<int> cells_;  ///< the items
    std::vector<Source> sources_;
};

}  // namespace forage::engine
