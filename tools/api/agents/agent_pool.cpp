#include "tools/api/agents/agent_pool.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/engine/parallel/thread_pool.h"
#include "core/run/argument_checks.h"
#include "core/run/weights.h"

namespace forage {
namespace {

constexpr std::size_t max_runs = 10'000;  ///< each takes megabytes

void check_count(std::size_t given, std::size_t runs, const char* what) {
    if (given > 0 && given != runs)
        throw InputError(fmt::format("there are {} {} for {} environments", given, what, runs));
}

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
    if (threads == 0) choice_ = Choice{};
}

AgentPool::~AgentPool() = default;

int AgentPool::threads() const { return threads_->threads(); }

void AgentPool::Choice::took(double seconds) {
    if (step_ == 0) best_.fill(std::numeric_limits<double>::infinity());
    if (step_ < 2 * tries) {
        double& best = best_[several() ? 1 : 0];
        best = std::min(best, seconds);
    }
    step_ = (step_ + 1) % period;
}

void AgentPool::reset(std::span<const std::optional<std::uint64_t>> seeds, std::span<const Pose2> starts,
                      std::span<const bool> mask, std::span<float> observations) {
    check_count(seeds.size(), size(), "seeds"), check_count(starts.size(), size(), "start poses");
    check_count(mask.size(), size(), "elements in the mask");
    for (const Pose2& start : starts) check_pose(start.x, start.y, start.yaw);
    const auto width = runs_.front().observation(0).size();
    auto work = [&](int item, int) {
        const auto i = static_cast<std::size_t>(item);
        if (mask.empty() || mask[i])
            runs_[i].reset(seeds.empty() ? std::nullopt : seeds[i],
                           starts.empty() ? starts : starts.subspan(i, 1));
        std::ranges::copy(runs_[i].observation(0),
                          observations.begin() + static_cast<std::ptrdiff_t>(i * width));
    };
    threads_->run(static_cast<int>(runs_.size()), work);
}

void AgentPool::set(std::span<const std::string> assignments) {
    check_count(assignments.size(), size(), "values");
    for (std::size_t i = 0; i < assignments.size(); ++i) runs_[i].run()->check(assignments[i]);
    for (std::size_t i = 0; i < assignments.size(); ++i) runs_[i].set(assignments[i]);
}

void AgentPool::set_weights(const std::string& connection, std::span<const double> weights) {
    const int number = find_connection(*runs_.front().run(), connection);
    const auto& layout = runs_.front().run()->layout();
    const auto& c = layout.connections[static_cast<std::size_t>(number)];
    const auto cells = [&](int g) {
        return static_cast<std::size_t>(layout.groups[static_cast<std::size_t>(g)].shape.cells);
    };
    const std::size_t one = cells(c.source) * cells(c.target);
    const auto of = [&](std::size_t i) {
        return weights.size() == one * size() ? weights.subspan(i * one, one) : weights;
    };
    for (std::size_t i = 0; i < size(); ++i) check_weights(*runs_[i].run(), number, of(i));
    for (std::size_t i = 0; i < size(); ++i) runs_[i].set_weights(connection, of(i));
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
    const auto start = std::chrono::steady_clock::now();
    const int count = static_cast<int>(runs_.size());
    if (!choice_ || choice_->several())
        threads_->run(count, work);
    else
        for (int i = 0; i < count; ++i) work(i, 0);
    if (choice_)
        choice_->took(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace forage
