// A cycle that threads share.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/engine/first_failure.h"
#include "core/engine/parallel/ready_groups.h"
#include "core/engine/parallel/thread_pool.h"
#include "core/engine/plan/plan.h"

namespace forage::engine {

/// Updates and deliveries of a system, for several threads at a time. Small groups go to one thread whole;
/// large ones, and those with large connections, are divided into parts of neighbouring cells. A thread gets
/// the same groups and parts in every loop of every cycle, as long as it is not late, and delivers to what
/// waited for its updates: what it wrote it finds in its own cache. The numbers are those of update() and
/// deliver_to().
class ParallelExecutor {
  public:
    /// No part of a group takes less than about `least` ns on one thread. Throws std::system_error when the
    /// threads cannot be started.
    ParallelExecutor(Plan& plan, int threads, double least);

    /// Divides groups and gives them to the threads: to be called again when some were left out.
    void share_out();

    int threads() const { return pool_.threads(); }
    /// With `deliver_early` groups are delivered to as soon as they can, and activities remembered. Where
    /// several groups fail, here and in deliver(), the exception of the first one comes out, as with one
    /// thread.
    void update_groups(std::uint64_t cycle, bool deliver_early);
    /// Delivers to all groups, or to those that had to wait. Throws what failed early, too.
    void deliver(std::uint64_t cycle);

  private:
    struct Item {
        int group, part;
        bool whole;  ///< who has this part does what is not divided
    };

    void divide();
    /// Calls work(group, item, thread) for all items, and notes who fails.
    template <class Work>
    void for_items(FirstFailure& failure, Work work);
    void deliver_early(int updated, int thread, std::uint64_t cycle);
    void deliver_waiting(std::uint64_t cycle);
    /// The connections of a group that is prepared, one after the other.
    void add_divided(GroupPlan& group, std::uint64_t cycle);

    Plan& plan_;
    ThreadPool pool_;
    int parts_;
    double least_;
    FirstFailure failed_update_, failed_delivery_;
    std::vector<Item> items_;
    std::vector<int> shares_;  ///< see ThreadPool
    std::optional<ReadyGroups> ready_;
    bool delivers_early_ = false;  ///< in this cycle
};

}  // namespace forage::engine
