// The short-term memory: prototypes and actions since the last goal.
#pragma once

#include <Eigen/Core>

#include "core/base/archive.h"

namespace forage::contextual {

using Eigen::Index;

/// A ring buffer of couplets of prototype and action, in single precision.
class ShortTermMemory {
  public:
    ShortTermMemory() = default;
    ShortTermMemory(Index slots, Index prototype_cells, Index action_cells)
        : prototypes_(Eigen::ArrayXXf::Zero(prototype_cells, slots)),
          actions_(Eigen::ArrayXXf::Zero(action_cells, slots)) {}

    /// Appends a couplet; it replaces the oldest one when all slots are used.
    void append(const Eigen::Ref<const Eigen::ArrayXd>& prototype,
                const Eigen::Ref<const Eigen::ArrayXd>& action) {
        prototypes_.col(next_) = prototype.cast<float>();
        actions_.col(next_) = action.cast<float>();
        next_ = (next_ + 1) % slots();
        if (size_ < slots()) ++size_;
    }
    void clear() { size_ = 0; }

    Index slots() const { return prototypes_.cols(); }
    Index size() const { return size_; }
    /// The prototype, or the action, of the couplet that was appended `age` couplets ago; 0 is the newest.
    auto prototype(Index age) const { return prototypes_.col(slot(age)); }
    auto action(Index age) const { return actions_.col(slot(age)); }

    void checkpoint(Archive& archive) { archive(prototypes_, actions_, next_, size_); }

  private:
    Index slot(Index age) const { return (next_ - 1 - age + slots()) % slots(); }

    Eigen::ArrayXXf prototypes_, actions_;  ///< one column per slot
    Index next_ = 0, size_ = 0;
};

}  // namespace forage::contextual
