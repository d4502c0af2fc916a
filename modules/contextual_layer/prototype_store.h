// A store of many prototypes, which are compared with one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/base/archive.h"
#include "modules/contextual_layer/cell_list.h"
#include "modules/contextual_layer/coarse_prototypes.h"

namespace forage::contextual {

/// Up to `keys` prototypes of N cells, each with a key below `keys`. They are stored in blocks in which cell
/// i of all prototypes is contiguous; there are no gaps, so that only stored prototypes cost time.
///
/// The distance of a stored prototype P to the present one p is 1/N sum_i |P_i / max P - p_i / max p|, and 1
/// when a maximum is not above 0. It is in 0..1 when no cell is negative. P_i / max P, 1/N and the running
/// sum are rounded to single precision as in the original, which takes most of the time. When only few exact
/// distances are needed, it is faster to estimate all of them first:
///
///     store.estimate(present, distances);
///     if (store.error() > 0) {
///         for (...) store.require(key);
///         store.refine(distances);
///     }
///
/// When most distances had to be made exact, the next comparisons do not estimate.
///
/// `distances` is indexed by key and must be the same array in every call, as distances that have not changed
/// are not written again. No function except the constructor allocates memory.
class PrototypeStore {
  public:
    PrototypeStore() = default;
    /// Makes a store with room for `capacity` prototypes.
    PrototypeStore(Index keys, Index capacity, Index cells);

    void add(Index key, const Eigen::Ref<const Eigen::ArrayXf>& prototype);
    void remove(Index key);
    Index size() const { return static_cast<Index>(keys_.size()); }

    /// Computes the exact distances of all stored prototypes.
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    /// Computes distances whose error is at most error().
    void estimate(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    /// An upper bound of the error of the distances; 0 when all are exact.
    float error() const { return estimated_ > 0 ? coarse_.error() : 0; }
    /// Requires that the next refine() makes the distance of a stored prototype exact. Allowed after
    /// estimate() until a prototype is added or removed.
    void require(Index key);
    /// Makes the required distances exact, and possibly others.
    void refine(float* distances);

    void checkpoint(Archive& archive) {
        archive(blocks_, silent_, keys_, slots_, compared_, current_, present_, active_, exact_,
                estimates_paused_);
        if (archive.loading()) rebuild_derived();
    }

  private:
    double* cells_of(Index slot) { return blocks_.data() + slot / lanes * cells_ * lanes + slot % lanes; }
    const std::uint64_t* used_by(Index block) const {
        return &used_[static_cast<std::size_t>(block * words_)];
    }
    Index blocks_in_use() const { return (size() + lanes - 1) / lanes; }
    void update_derived(Index slot);
    void rebuild_derived();
    bool set_present(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
    bool can_estimate() const;
    void require_block(Index block);
    void require_all();
    void compare_required(float* distances);
    void list_cells(Index first, Index second);
    void write_distances(Index block, const float* found, float* distances) const;

    Index cells_ = 0;
    Index words_ = 0;                    ///< number of words in a bit set with one bit per cell
    Eigen::ArrayXd blocks_;              ///< [block][cell][lane]: P / max P in single precision, 0 if unused
    std::vector<std::uint8_t> silent_;   ///< per slot: whether max P is 0
    std::vector<Index> keys_;            ///< key per used slot
    std::vector<Index> slots_;           ///< slot per key
    Eigen::ArrayXd compared_;            ///< p of the last comparison
    bool current_ = false;               ///< whether the distances are those of compared_
    Eigen::ArrayXd present_;             ///< p / max p
    std::vector<std::uint64_t> active_;  ///< bit set of the cells of present_ that are not 0
    std::vector<std::uint8_t> exact_;  ///< per block: whether its distances are exact, or will be by refine()
    int estimates_paused_ = 0;         ///< number of the next comparisons that do not estimate

    // ---- derived from the above ----
    std::vector<std::uint64_t> used_;  ///< [block][word]: bit set of the cells that are not 0 in some lane
    CoarsePrototypes coarse_;
    std::vector<std::uint8_t>
        out_of_range_;              ///< per slot: whether a P_i / max P is not in 0..1; it is not in coarse_
    Index out_of_range_count_ = 0;  ///< number of slots
    Index estimated_ = 0;           ///< number of blocks whose distances are not exact

    // ---- temporary ----
    CellList listed_;
    std::vector<Index> required_;  ///< blocks
};

}  // namespace forage::contextual
