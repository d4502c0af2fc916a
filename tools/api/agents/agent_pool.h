// Many runs with one agent each, stepped together on several threads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tools/api/agents/agents.h"

namespace forage::engine {
class ThreadPool;
}

namespace forage {

/// Runs of the same task. Each of them begins its next episode by itself, in the step after the one that
/// ended an episode; the action of that step is ignored, and its reward is 0. The numbers do not depend on
/// the number of threads.
class AgentPool {
  public:
    /// Where a step writes what it brought: one row per run.
    struct Rows {
        std::span<float> observations;
        std::span<double> rewards;
        std::span<bool> terminated, truncated, reached_target;
    };

    /// Run i has the seed of the task plus i. `threads` is the largest number of threads; 0: one per core.
    /// Throws InputError.
    AgentPool(const std::shared_ptr<const AgentTask>& task, std::size_t runs, int threads = 0);
    ~AgentPool();

    std::size_t size() const { return runs_.size(); }
    int threads() const;
    AgentRun& operator[](std::size_t i) { return runs_[i]; }

    /// Begins an episode of all runs; with seeds, one per run, they are opened again. `starts` is empty or
    /// has the start pose of each robot. Throws InputError.
    void reset(std::span<const std::uint64_t> seeds, std::span<const Pose2> starts,
               std::span<float> observations);
    /// Runs one step of each run. `actions` has a row per run. Throws InputError before the first run steps,
    /// and engine::RunError; of several runs that fail, that of the first one.
    void step(std::span<const double> actions, const Rows& rows);

  private:
    std::vector<AgentRun> runs_;
    std::unique_ptr<engine::ThreadPool> threads_;
};

}  // namespace forage
