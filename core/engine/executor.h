// What shares a cycle among threads; core/engine/parallel has it, and can be left out of a build.
#pragma once

#include <memory>

#include "core/engine/cycle.h"

namespace forage::engine {

class Executor {
  public:
    virtual ~Executor() = default;
    virtual int threads() const = 0;
    /// Whether threads share the cycle that begins.
    virtual bool begin() = 0;
    // Such a cycle: the phases of Cycle with the same names. They give the same numbers.
    virtual void update_groups() = 0;
    virtual void deliver() = 0;
    /// Ends any cycle.
    virtual void end() = 0;
};

/// Null when there is nothing to share: in a build without threads, for one thread, and for a system whose
/// cycles take less than `threshold_ns` on one thread. With a threshold of 0 all cycles are shared. No part
/// of a divided group takes less than `min_task_ns`. Throws std::system_error when the threads cannot be
/// started.
std::unique_ptr<Executor> make_executor(const Plan& plan, Cycle& cycle, int threads, double threshold_ns,
                                        double min_task_ns);

}  // namespace forage::engine
