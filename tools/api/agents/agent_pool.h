// Many runs with one agent each, stepped together on several threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

    /// Run i has the seed of the task plus i. `threads` is the number of threads; 0: one per core in steps
    /// where that is faster than one. Throws InputError.
    AgentPool(const std::shared_ptr<const AgentTask>& task, std::size_t runs, int threads = 0);
    ~AgentPool();

    std::size_t size() const { return runs_.size(); }
    int threads() const;
    AgentRun& operator[](std::size_t i) { return runs_[i]; }

    /// Begins an episode of the runs that `mask` names, of all when it is empty; those that `seeds` has a
    /// seed for are restarted. `starts` is empty or has the start pose of each robot. Writes the observations
    /// of all runs. Throws InputError.
    void reset(std::span<const std::optional<std::uint64_t>> seeds, std::span<const Pose2> starts,
               std::span<const bool> mask, std::span<float> observations);
    /// Sets a parameter of each run, as AgentRun::set() does. Throws InputError, and changes nothing.
    void set(std::span<const std::string> assignments);
    /// Sets the weights of a connection of each run: one matrix after the other, or one for all. Throws
    /// InputError, and changes nothing.
    void set_weights(const std::string& connection, std::span<const double> weights);
    /// Runs one step of each run. `actions` has a row per run. Throws InputError before the first run steps,
    /// and engine::RunError; of several runs that fail, that of the first one.
    void step(std::span<const double> actions, const Rows& rows);

  private:
    /// Which is faster for a step, one thread or several: it depends on the runs and on what else the cores
    /// do. So both are tried in the first few of each period of steps.
    class Choice {
      public:
        bool several() const { return step_ < 2 * tries ? step_ >= tries : best_[1] < best_[0]; }
        /// Takes the seconds of a step.
        void took(double seconds);

      private:
        static constexpr int tries = 4, period = 512;
        int step_ = 0;
        std::array<double, 2> best_{};  ///< of one thread, and of several
    };

    std::vector<AgentRun> runs_;
    std::unique_ptr<engine::ThreadPool> threads_;
    std::optional<Choice> choice_;  ///< empty when the number of threads was given
};

}  // namespace forage
