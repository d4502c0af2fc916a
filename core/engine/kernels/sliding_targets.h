// The targets of plastic synapses by source, where neighbouring frames share most of them.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/engine/kernels/target_frame.h"

namespace forage::engine {

/// What the targets of a frame hold, in a column in which a target stays at its place from one frame to the
/// next. So only those are copied that enter a frame or leave it: of windows that move along a row of cells,
/// one column of targets in place of eleven.
///
/// A line is what the runs of all frames cover without a gap, such as a row of cells. It has as many places
/// as a frame has targets of it at most, filled up to a multiple of `lanes`. The places of a source are those
/// of the lines that it reaches. Some of them are free: they hold what somebody left there, an update
/// computes something with it, and nobody takes that back.
class SlidingTargets {
  public:
    static constexpr Index lanes = 4;

    /// Empty where most targets do not stay, where many places would be free, or where a source does not
    /// reach all that the frame has of its lines.
    static std::optional<SlidingTargets> make(const SourceOrder& order, int target_cells);

    const std::vector<Stretch>& sources() const { return sources_; }  ///< places, of the sources in order
    Index places() const { return places_; }
    /// Of the targets of all sources, one source after the other, in ascending order: counted from the
    /// source's first place. To be taken once.
    std::vector<int> take_target_places() { return std::move(target_places_); }

    struct Move {
        int target, place;
    };
    /// From frame `frame` - 1 to frame `frame`. Nobody leaves before the first frame, and all do after the
    /// last one.
    std::span<const Move> leaving(std::size_t frame) const { return of(leaving_, first_leaving_, frame); }
    std::span<const Move> entering(std::size_t frame) const { return of(entering_, first_entering_, frame); }

  private:
    static std::span<const Move> of(const std::vector<Move>& moves, const std::vector<std::size_t>& first,
                                    std::size_t frame) {
        return {moves.data() + first[frame], moves.data() + first[frame + 1]};
    }

    std::vector<Stretch> sources_;
    Index places_ = 0;
    std::vector<int> target_places_;
    std::vector<Move> leaving_, entering_;
    std::vector<std::size_t> first_leaving_{0}, first_entering_{0};  ///< by frame; one more than there are
};

}  // namespace forage::engine
