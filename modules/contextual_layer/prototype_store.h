// Many prototypes, compared with one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/types/archive.h"

namespace forage::contextual {

using Eigen::Index;

/// Up to `keys` prototypes of N cells, each under a number below `keys`. They lie densely, in blocks of which
/// cell i of all lies side by side, so that what is not there costs nothing.
class PrototypeStore {
  public:
    PrototypeStore() = default;
    /// Room for at most `capacity` prototypes at a time.
    PrototypeStore(Index keys, Index capacity, Index cells);

    void add(Index key, const Eigen::Ref<const Eigen::ArrayXf>& prototype);
    void remove(Index key);
    Index size() const { return static_cast<Index>(keys_.size()); }

    /// distances[key] = 1/N sum_i |P_i / max P - p_i / max p| for every stored prototype P and the present
    /// one, p; 1 when a maximum is not above 0. In 0..1 when no cell is negative. Rounded where the original
    /// rounds: P_i / max P, 1/N and the running sum to single precision. Allocates nothing. `distances` is
    /// the same array every time: what is known to be in it is not written again.
    void compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances);

    void checkpoint(Archive& archive) {
        archive(blocks_, used_, silent_, keys_, slots_, compared_, current_, present_, active_);
    }

  private:
    static constexpr Index lanes = 16;  ///< prototypes per block

    double* cells_of(Index slot) { return blocks_.data() + slot / lanes * cells_ * lanes + slot % lanes; }
    void note_use(Index block);
    void compare_blocks(Index first, Index count, float* distances);

    Index cells_ = 0, words_ = 0;        ///< words_: of a bit per cell
    Eigen::ArrayXd blocks_;              ///< P / max P, of single precision; [block][cell][lane], 0 if unused
    std::vector<std::uint64_t> used_;    ///< [block][word]: cells of which some lane is not 0
    std::vector<std::uint8_t> silent_;   ///< per slot: max P is 0
    std::vector<Index> keys_;            ///< of the slots in use
    std::vector<Index> slots_;           ///< by key
    Eigen::ArrayXd compared_;            ///< p of the last comparison
    bool current_ = false;               ///< the distances of the last comparison hold for compared_
    Eigen::ArrayXd present_;             ///< p / max p
    std::vector<std::uint64_t> active_;  ///< cells of present_ that are not 0
    /// The cells that count for two blocks, in order, and perhaps some more.
    struct CellList {
        std::vector<std::uint64_t> of;  ///< a bit per cell
        std::vector<Index> cells;
        Index count = 0, in_vain = 0;  ///< in_vain: cells that added nothing, since the list was made
        void list(const std::uint64_t* first, const std::uint64_t* second, const std::uint64_t* present,
                  Index words);
    };
    CellList counted_;  ///< scratch
};

}  // namespace forage::contextual
