#include "tools/api/agents/agent_pool.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/engine/parallel/thread_pool.h"
#include "core/run/argument_checks.h"

namespace forage {
namespace {

constexpr std::size_t max_runs = 10'000;  ///< each takes megabytes

}  // namespace

AgentPool::AgentPool(const std::shared_ptr<const AgentTask>& task, std::size_t runs, int threads) {
    Diagnostics diagnostics;
    if (runs == 0 || runs > max_runs)
        diagnostics.error({}, fmt::format("{} environments cannot be stepped together", runs),
                          fmt::format("a whole number from 1 to {}", max_runs));
    if (threads != 0) check_threads(threads, diagnostics);
    throw_errors(std::move(diagnostics));
    runs_.emplace_back(task);
    for (std::size_t i = 1; i < runs; ++i) runs_.emplace_back(runs_.front(), task->options().input.seed + i);
    const auto usable = static_cast<std::size_t>(threads > 0 ? threads : cores());
    threads_ = std::make_unique<engine::ThreadPool>(static_cast<int>(std::min(usable, runs)));
}

AgentPool::~AgentPool() = default;

int AgentPool::threads() const { return threads_->threads(); }

void AgentPool::reset(std::span<const std::uint64_t> seeds, std::span<const Pose2> starts,
                      std::span<float> observations) {
    if (!starts.empty() && starts.size() != runs_.size())
        throw InputError(
            fmt::format("there are {} start poses for {} environments", starts.size(), runs_.size()));
    for (const Pose2& start : starts) check_pose(start.x, start.y, start.yaw);
    const auto width = runs_.front().observation(0).size();
    auto work = [&](int item, int) {
        const auto i = static_cast<std::size_t>(item);
        runs_[i].reset(seeds.empty() ? std::nullopt : std::optional(seeds[i]),
                       starts.empty() ? starts : starts.subspan(i, 1));
        std::ranges::copy(runs_[i].observation(0),
                          observations.begin() + static_cast<std::ptrdiff_t>(i * width));
    };
    threads_->run(static_cast<int>(runs_.size()), work);
}

void AgentPool::step(std::span<const double> actions, const Rows& rows) {
    const auto width = runs_.front().observation(0).size(), numbers = runs_.front().action_size(0);
    for (std::size_t i = 0; i < runs_.size(); ++i)
        if (!runs_[i].ended()) runs_[i].act(0, actions.subspan(i * numbers, numbers));
    auto work = [&](int item, int) {
        const auto i = static_cast<std::size_t>(item);
        AgentRun& run = runs_[i];
        run.ended() ? run.reset() : run.step();
        std::ranges::copy(run.observation(0),
                          rows.observations.begin() + static_cast<std::ptrdiff_t>(i * width));
        const auto& outcome = run.outcome(0);
        rows.rewards[i] = outcome.reward;
        rows.terminated[i] = outcome.terminated, rows.truncated[i] = outcome.truncated;
        rows.reached_target[i] = outcome.reached_target;
    };
    threads_->run(static_cast<int>(runs_.size()), work);
}

}  // namespace forage
