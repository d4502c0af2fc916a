// Many prototypes, compared with one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/base/archive.h"
#include "modules/contextual_layer/cell_list.h"
#include "modules/contextual_layer/coarse_prototypes.h"

namespace forage::contextual {

/// Up to `keys` prototypes of N cells, each under a number below `keys`. They lie densely, in blocks of which
/// cell i of all lies side by side, so that what is not there costs nothing.
///
/// The distance of a stored prototype P and the present one p is 1/N sum_i |P_i / max P - p_i / max p|, and 1
/// when a maximum is not above 0; in 0..1 when no cell is negative. It is rounded where the original rounds:
/// P_i / max P, 1/N and the running sum to single precision, which takes most of the time. Who needs few of
/// them lets all be estimated and makes those exact:
///
///     store.estimate(present, distances);
///     if (store.error() > 0) {
///         for (...) store.need(key);
///         store.refine(distances);
///     }
///
/// Estimates are given up for a while where most of them had to be made exact.
///
/// `distances` is the same array every time, by key: what is known to be in it is not written again. Nothing
/// here allocates.
class PrototypeStore {
  public:
    PrototypeStore() = default;
    /// Room for at most `capacity` prototypes at a time.
    PrototypeStore(Index keys, Index capacity, Index cells);

    void add(Index key, const Eigen::Ref<const Eigen::ArrayXf>& prototype);
    void remove(Index key);
    Index size() const { return static_cast<Index>(keys_.size()); }

    /// Tells the distances of all stored prototypes.
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    /// The same, but they may be off by error().
    void estimate(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    /// How much a distance may be off; 0 when all are exact.
    float error() const { return estimated_ > 0 ? coarse_.error() : 0; }
    /// Has the next refine() make the distance of a stored prototype exact. Only after an estimate, and
    /// before anything is added or removed.
    void need(Index key);
    /// Makes distances exact, those that are needed and perhaps others.
    void refine(float* distances);

    void checkpoint(Archive& archive) {
        archive(blocks_, silent_, keys_, slots_, compared_, current_, present_, active_, exact_, in_vain_);
        if (archive.loading()) restore();
    }

  private:
    double* cells_of(Index slot) { return blocks_.data() + slot / lanes * cells_ * lanes + slot % lanes; }
    const std::uint64_t* used_by(Index block) const {
        return &used_[static_cast<std::size_t>(block * words_)];
    }
    Index blocks_in_use() const { return (size() + lanes - 1) / lanes; }
    void note_cells(Index slot);
    void restore();
    bool take(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    bool can_estimate() const;
    void need_block(Index block);
    void need_all();
    void compare_needed(float* distances);
    void list_cells(Index first, Index second);
    void tell(Index block, const float* found, float* distances) const;

    Index cells_ = 0, words_ = 0;        ///< words_: of a bit per cell
    Eigen::ArrayXd blocks_;              ///< P / max P, of single precision; [block][cell][lane], 0 if unused
    std::vector<std::uint8_t> silent_;   ///< per slot: max P is 0
    std::vector<Index> keys_;            ///< of the slots in use
    std::vector<Index> slots_;           ///< by key
    Eigen::ArrayXd compared_;            ///< p of the last comparison
    bool current_ = false;               ///< the distances of the last comparison hold for compared_
    Eigen::ArrayXd present_;             ///< p / max p
    std::vector<std::uint64_t> active_;  ///< cells of present_ that are not 0
    std::vector<std::uint8_t> exact_;    ///< per block: its distances are exact, or it is in needed_
    int in_vain_ = 0;                    ///< for so many comparisons estimates are not tried

    // What follows from the above.
    std::vector<std::uint64_t> used_;  ///< [block][word]: cells of which some lane is not 0
    CoarsePrototypes coarse_;
    std::vector<std::uint8_t> odd_;  ///< per slot: some P_i / max P is not in 0..1, so that coarse_ has not P
    Index odd_ones_ = 0;
    Index estimated_ = 0;  ///< blocks that are not exact

    // Scratch.
    CellList counted_;
    std::vector<Index> needed_;  ///< blocks
};

}  // namespace forage::contextual
