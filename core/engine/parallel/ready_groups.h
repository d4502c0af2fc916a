// Which groups can be delivered to while several threads update.
#pragma once

#include <atomic>
#include <span>
#include <vector>

namespace forage::engine {

struct Plan;

/// What EarlyDelivery is for one thread: a group is delivered to as soon as it and all its sources are
/// updated, by the thread that updates the last of them, which finds that one in its cache. Groups that
/// modules write to, or of which threads divide the delivery or a source's update, have to wait until all are
/// updated; so do those of which several become ready at once, when what is delivered to them is worth
/// sharing.
class ReadyGroups {
  public:
    /// `shares`: the groups that are updated whole, by the thread that usually does it: groups of a thread
    /// are counted in lines of the cache that others seldom ask for. `worth`: ns of deliveries.
    ReadyGroups(const Plan& plan, std::span<const std::vector<int>> shares, double worth);

    /// To be called before the updates of a cycle.
    void begin();
    /// To be called when an update has failed, so that others were not awaited to the end.
    void restart();
    /// To be called when a group is updated, by the thread that did it: calls deliver(group) for those that
    /// waited for nothing else. Any number of threads at a time.
    template <class Deliver>
    void updated(int group, int thread, Deliver deliver) {
        const int mine = -1 - thread;
        int ready = 0, last = 0;
        double cost = 0;
        each_reader(group, [&](int reader) {
            if (missing(reader).fetch_sub(1, std::memory_order_acq_rel) > 1) return;
            missing(reader).store(mine, std::memory_order_relaxed);
            ++ready, last = reader;
            cost += groups_[static_cast<std::size_t>(reader)].cost;
        });
        const bool waits = ready > chained && cost >= worth_;
        const auto take = [&](int reader) {
            missing(reader).store(groups_[static_cast<std::size_t>(reader)].awaited,
                                  std::memory_order_relaxed);  // for the next cycle
            if (waits)
                left_[static_cast<std::size_t>(reader)] = 1;
            else
                deliver(reader);
        };
        if (ready == 1)
            take(last);
        else if (ready > 1)
            each_reader(group, [&](int reader) {
                if (missing(reader).load(std::memory_order_relaxed) == mine) take(reader);
            });
        if (waits) some_left_.store(true, std::memory_order_relaxed);
    }

    // When all are updated, by one thread:
    bool some_wait() const { return some_late_ || some_left_.load(std::memory_order_relaxed); }
    bool waits(int group) const {
        return groups_[static_cast<std::size_t>(group)].awaited == 0 ||
               left_[static_cast<std::size_t>(group)];
    }

  private:
    /// As many are ready at once where the end of one thread's chain meets the beginning of another's.
    static constexpr int chained = 2;

    struct Group {
        int first_reader = 0, last_reader = 0;  ///< in `readers_`: who waits for its update
        int count = 0;                          ///< in `missing_`
        int awaited = 0;  ///< updates before it can be delivered to; 0: it waits for all
        double cost = 0;  ///< ns, of delivering
    };

    template <class Visit>
    void each_reader(int group, Visit visit) {
        const auto& g = groups_[static_cast<std::size_t>(group)];
        for (int i = g.first_reader; i < g.last_reader; ++i) visit(readers_[static_cast<std::size_t>(i)]);
    }
    std::atomic<int>& missing(int group) {
        return missing_[static_cast<std::size_t>(groups_[static_cast<std::size_t>(group)].count)];
    }

    double worth_;
    bool some_late_ = false;
    std::vector<Group> groups_;
    std::vector<int> readers_;
    std::vector<std::atomic<int>> missing_;  ///< updates that are awaited; -1 - t: ready, and thread t's
    std::vector<char> left_;                 ///< ready in this cycle, but not delivered to
    std::atomic<bool> some_left_ = false;
};

}  // namespace forage::engine
