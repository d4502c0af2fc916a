// Which groups can be delivered to while several threads update.
#pragma once

#include <atomic>
#include <span>
#include <vector>

namespace forage::engine {

struct Plan;

/// What EarlyDelivery is for one thread: a group is delivered to as soon as it and all its sources are
/// updated, by the thread that updates the last of them, which finds that one in its cache. Groups that
/// modules write to, and those that threads divide, have to wait.
class ReadyGroups {
  public:
    /// `shares`: the groups that are updated whole, by the thread that usually does it. Groups of a thread
    /// are counted in lines of the cache that others seldom ask for.
    ReadyGroups(const Plan& plan, std::span<const std::vector<int>> shares);

    /// To be called when a group is updated, by the thread that did it: calls deliver(group) for each that
    /// waited for nothing else. Any number of threads at a time.
    template <class Deliver>
    void updated(int group, Deliver deliver) {
        const auto& g = groups_[static_cast<std::size_t>(group)];
        for (int i = g.first_reader; i < g.last_reader; ++i) {
            const int reader = readers_[static_cast<std::size_t>(i)];
            const auto& r = groups_[static_cast<std::size_t>(reader)];
            auto& missing = missing_[static_cast<std::size_t>(r.count)];
            if (missing.fetch_sub(1, std::memory_order_acq_rel) > 1) continue;
            missing.store(r.awaited, std::memory_order_relaxed);  // for the next cycle
            deliver(reader);
        }
    }
    /// Begins anew, after a cycle that was not ended.
    void restart();

    /// Groups that are not delivered to before all are updated, in order.
    const std::vector<int>& late() const { return late_; }
    bool is_late(int group) const { return groups_[static_cast<std::size_t>(group)].awaited == 0; }

  private:
    struct Group {
        int first_reader = 0, last_reader = 0;  ///< in `readers_`: who waits for its update
        int count = 0;                          ///< in `missing_`
        int awaited = 0;                        ///< updates before it can be delivered to; 0: it is late
    };

    std::vector<Group> groups_;
    std::vector<int> readers_, late_;
    std::vector<std::atomic<int>> missing_;  ///< updates of this cycle that are still awaited
};

}  // namespace forage::engine
