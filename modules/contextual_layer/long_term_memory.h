// Sequences that led to a goal, and how much each of their segments is like the present.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "modules/contextual_layer/prototype_store.h"
#include "modules/contextual_layer/short_term_memory.h"

namespace forage::contextual {

/// One number per segment: sequences by rows, time by columns.
using SegmentArray = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// NL sequences of up to min(NL, NS) segments, each a prototype of N cells and an action of M, in single
/// precision. Column 0 is the segment nearest to the goal, column 1 the one before. The live segments of a
/// sequence are its columns from 0 up to length(row). An unused segment has distance 1 and collector, trigger
/// and selected 0.
class LongTermMemory {
  public:
    LongTermMemory() = default;
    LongTermMemory(Index sequences, Index segments, Index prototype_cells, Index action_cells);

    Index sequences() const { return distance_.rows(); }  ///< NL
    Index segments() const { return distance_.cols(); }   ///< NS
    Index longest() const { return longest_; }            ///< min(NL, NS), of a sequence
    Index length(Index row) const { return lengths_[static_cast<std::size_t>(row)]; }

    /// Stores what `memory` holds, at most its newest longest() couplets, as the next sequence; when the
    /// memory is full it takes the place of the oldest one.
    void store(const ShortTermMemory& memory);
    /// The sequence that the next store() overwrites.
    Index next_row() const { return next_; }

    /// Compares every live segment's prototype with the present one: distance d (see PrototypeStore).
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& prototype);
    /// The same, but distances, and the collectors that are made of them, may be nearly right until settle()
    /// makes those exact that matter.
    void estimate(const Eigen::Ref<const Eigen::ArrayXd>& prototype);
    /// A live segment's trigger t <- (1 - decay) t + decay where it is above 1, else t <- 1; then its
    /// collector c = (1 - d) t.
    void collect(float decay);
    /// Makes exact the distances and collectors of all segments that may be selected: whose collector may be
    /// above `threshold` and at least `share` of the largest. What is left of estimates is too small to be
    /// selected, or to be the largest where any is.
    void settle(float threshold, float share);

    const SegmentArray& distance() const { return distance_; }
    const SegmentArray& collector() const { return collector_; }
    SegmentArray& trigger() { return trigger_; }
    const SegmentArray& trigger() const { return trigger_; }
    SegmentArray& selected() { return selected_; }  ///< 1 or 0
    const SegmentArray& selected() const { return selected_; }
    /// The largest collector of a row's live segments, 0 if none is above 0.
    float peak(Index row) const { return peaks_[static_cast<std::size_t>(row)]; }
    /// Whether a segment of the row is selected; to be kept by whoever selects.
    std::uint8_t& speaks(Index row) { return speaks_[static_cast<std::size_t>(row)]; }
    bool speaks(Index row) const { return speaks_[static_cast<std::size_t>(row)]; }
    /// Action of a live segment, M cells.
    auto action(Index row, Index column) const { return actions_.col(row * longest_ + column); }

    void checkpoint(Archive& archive) {
        archive(prototypes_, actions_, lengths_, distance_, collector_, trigger_, selected_, peaks_, speaks_,
                next_);
    }

  private:
    Index longest_ = 0;
    PrototypeStore prototypes_;  ///< of the live segments; key row NS + column
    Eigen::ArrayXXf actions_;    ///< M x (sequences longest)
    std::vector<Index> lengths_;
    SegmentArray distance_, collector_, trigger_, selected_;
    std::vector<float> peaks_;          ///< per row
    float highest_trigger_ = 0;         ///< largest |t| of a live segment, since collect()
    std::vector<std::uint8_t> speaks_;  ///< per row
    Index next_ = 0;
};

}  // namespace forage::contextual
