// A store of many prototypes, which are compared with one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/base/archive.h"
#include "modules/contextual_layer/cell_list.h"

namespace forage::contextual {

constexpr Index lanes = 16;  ///< prototypes per block; cell i of all of them is contiguous in memory

/// Up to `keys` prototypes of N cells, each with a key below `keys`. They are stored in blocks in which cell
/// i of all prototypes is contiguous; there are no gaps, so that only stored prototypes cost time.
///
/// The distance of a stored prototype P to the present one p is 1/N sum_i |P_i / max P - p_i / max p|, and 1
/// when a maximum is not above 0. It is in 0..1 when no cell is negative. P_i / max P, 1/N and the running
/// sum are rounded to single precision as in the original.
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

    /// Computes the distances of all stored prototypes.
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);

    void checkpoint(Archive& archive) {
        archive(blocks_, silent_, keys_, slots_, compared_, current_, present_, active_);
        if (!archive.loading()) return;
        for (Index block = 0; block < std::ssize(silent_) / lanes; ++block) note_used(block);
    }

  private:
    double* cells_of(Index slot) { return blocks_.data() + slot / lanes * cells_ * lanes + slot % lanes; }
    const std::uint64_t* used_by(Index block) const {
        return &used_[static_cast<std::size_t>(block * words_)];
    }
    Index blocks_in_use() const { return (size() + lanes - 1) / lanes; }
    void note_used(Index block);
    bool set_present(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);
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
    std::vector<std::uint64_t> used_;    ///< [block][word]: the cells that are not 0 in some lane; derived
    CellList listed_;                    ///< temporary
};

}  // namespace forage::contextual
