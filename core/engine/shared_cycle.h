// A cycle that threads share.
#pragma once

#include <cstdint>
#include <vector>

#include "core/engine/plan.h"
#include "core/engine/thread_pool.h"

namespace forage::engine {

/// Updates and deliveries of a system, for several threads at a time. Small groups go to one thread whole;
/// large ones, and those with large connections, are divided into parts of neighbouring cells. A thread gets
/// the same groups and parts in every loop of every cycle, as long as it is not late: what it wrote in one
/// loop it finds in its own cache in the next. The numbers are those of update() and deliver_to().
class SharedCycle {
  public:
    /// Notes in the groups how they are divided: no part takes less than about `least` ns on one thread.
    /// Throws std::system_error when the threads cannot be started.
    SharedCycle(Plan& plan, int threads, double least);

    /// Gives the groups that are updated to the threads: to be called again when some were left out.
    void share_out();

    int threads() const { return pool_.threads(); }
    void update_groups(std::uint64_t cycle);
    void deliver(std::uint64_t cycle);

  private:
    struct Item {
        int group, part;
    };

    void divide(double least);

    Plan& plan_;
    ThreadPool pool_;
    int parts_;
    std::vector<Item> items_;  ///< whole groups are part 0
    std::vector<int> shares_;  ///< see ThreadPool
};

}  // namespace forage::engine
