// Which groups can be delivered to before all are updated.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace forage::engine {

struct Plan;

/// The groups whose updates what is delivered to `group` waits for: itself and its sources, each once.
std::vector<int> awaited_updates(const Plan& plan, int group);

/// What is delivered to a group is read in the next cycle. So it can be delivered as soon as the group itself
/// and all its sources are updated, while their numbers are still in the nearest cache: in a chain of small
/// groups, always just after the update. Groups that modules write to have to wait for these.
class EarlyDelivery {
  public:
    explicit EarlyDelivery(const Plan& plan);

    /// Groups that can be delivered to after the `k`-th update: of plan.updated[k].
    std::span<const int> after(std::size_t k) const {
        return std::span(groups_).subspan(begin_[k], begin_[k + 1] - begin_[k]);
    }
    /// Groups that have to wait for the modules, in order.
    const std::vector<int>& late() const { return late_; }

  private:
    std::vector<int> groups_;
    std::vector<std::size_t> begin_;  ///< in `groups_`, by update; one more than there are
    std::vector<int> late_;
};

}  // namespace forage::engine
