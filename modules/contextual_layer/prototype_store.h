// Many prototypes, compared with one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/types/archive.h"

namespace forage::contextual {

using Eigen::Index;

/// Up to `keys` prototypes of N cells in single precision, each under a number below `keys`. They lie
/// densely, in blocks of which cell i of all lies side by side, so that what is not there costs nothing.
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
        archive(blocks_, used_, silent_, keys_, slots_, compared_, current_, present_);
    }

  private:
    static constexpr Index lanes = 16;  ///< prototypes per block
    using Lanes = Eigen::Array<double, lanes, 1>;

    float* cells_of(Index slot) { return blocks_.data() + slot / lanes * cells_ * lanes + slot % lanes; }
    void note_use(Index block);
    Lanes distances_of(Index block);

    Index cells_ = 0;
    Eigen::ArrayXf blocks_;             ///< P / max P; [block][cell][lane], unused lanes are 0
    std::vector<std::uint8_t> used_;    ///< [block][cell]: some lane is not 0
    std::vector<std::uint8_t> silent_;  ///< per slot: max P is 0
    std::vector<Index> keys_;           ///< of the slots in use
    std::vector<Index> slots_;          ///< by key
    Eigen::ArrayXd compared_;           ///< p of the last comparison
    bool current_ = false;              ///< the distances of the last comparison hold for compared_
    Eigen::ArrayXd present_;            ///< p / max p
    std::vector<Index> worth_;          ///< scratch: cells that count in a block
};

}  // namespace forage::contextual
