// The interface of what shares a cycle among threads. core/engine/parallel implements it, and can be left out
// of a build.
#pragma once

#include <memory>

#include "core/engine/cycle.h"

namespace forage::engine {

class Executor {
  public:
    virtual ~Executor() = default;
    virtual int threads() const = 0;
    /// Begins a cycle. Returns whether threads share it.
    virtual bool begin() = 0;
    // The phases of a shared cycle, which give the same numbers as the functions of Cycle with these names.
    virtual void update_groups() = 0;
    virtual void deliver() = 0;
    /// Ends a cycle, whether it was shared or not.
    virtual void end() = 0;
};

/// Makes an executor. The result is null when there is nothing to share: in a build without threads, for one
/// thread, and for a system whose cycles take less than `threshold_ns` on one thread. With a threshold of 0
/// all cycles are shared. No part of a divided group takes less than `min_task_ns`. Throws std::system_error
/// when the threads cannot be started.
std::unique_ptr<Executor> make_executor(const Plan& plan, Cycle& cycle, int threads, double threshold_ns,
                                        double min_task_ns);

}  // namespace forage::engine
