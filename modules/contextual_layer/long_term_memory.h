// The long-term memory: sequences that led to a goal, and the similarity of their segments to the present.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "modules/contextual_layer/prototype_store.h"
#include "modules/contextual_layer/short_term_memory.h"

namespace forage::contextual {

/// One number per segment: a row per sequence, a column per time step.
using SegmentArray = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// NL sequences of at most min(NL, NS) segments. A segment has a prototype of N cells and an action of M
/// cells, in single precision. Column 0 is the segment nearest to the goal, column 1 the one before it. The
/// columns from 0 to length(row) - 1 are used. An unused segment has distance 1 and collector, trigger and
/// selected 0.
class LongTermMemory {
  public:
    LongTermMemory() = default;
    LongTermMemory(Index sequences, Index segments, Index prototype_cells, Index action_cells);

    Index sequences() const { return distance_.rows(); }  ///< NL
    Index segments() const { return distance_.cols(); }   ///< NS
    Index length(Index row) const { return lengths_[static_cast<std::size_t>(row)]; }

    /// Stores the couplets of `memory`, at most the newest min(NL, NS) of them, as the next sequence. It
    /// replaces the oldest sequence when all rows are used.
    void store(const ShortTermMemory& memory);
    /// The row to which the next store() writes.
    Index next_row() const { return next_; }

    /// Computes the distance d of the present prototype to that of each used segment (see PrototypeStore).
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& prototype);
    /// Updates the triggers and collectors of all used segments: t <- (1 - decay) t + decay if t is above 1,
    /// else t <- 1; then c = (1 - d) t.
    void collect(float decay);

    const SegmentArray& distance() const { return distance_; }
    const SegmentArray& collector() const { return collector_; }
    SegmentArray& trigger() { return trigger_; }
    const SegmentArray& trigger() const { return trigger_; }
    SegmentArray& selected() { return selected_; }  ///< 1 or 0
    const SegmentArray& selected() const { return selected_; }
    /// The largest collector of a row, or 0 if none is above 0.
    float peak(Index row) const { return peaks_[static_cast<std::size_t>(row)]; }
    /// Whether a segment of the row is selected; maintained by select().
    std::uint8_t& has_selection(Index row) { return has_selection_[static_cast<std::size_t>(row)]; }
    bool has_selection(Index row) const { return has_selection_[static_cast<std::size_t>(row)]; }
    /// The action of a used segment, M values.
    auto action(Index row, Index column) const { return actions_.col(row * max_length_ + column); }

    void checkpoint(Archive& archive) {
        archive(prototypes_, actions_, lengths_, distance_, collector_, trigger_, selected_, peaks_,
                has_selection_, next_);
    }

  private:
    Index max_length_ = 0;       ///< of a sequence: min(NL, NS)
    PrototypeStore prototypes_;  ///< prototypes of the used segments; a key is row NS + column
    Eigen::ArrayXXf actions_;    ///< M x (NL max_length)
    std::vector<Index> lengths_;
    SegmentArray distance_, collector_, trigger_, selected_;
    std::vector<float> peaks_;                 ///< largest collector per row
    std::vector<std::uint8_t> has_selection_;  ///< per row: whether a segment is selected
    Index next_ = 0;
};

}  // namespace forage::contextual
