// The past of a run: checkpoints in memory, and the actions between them.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/run/run.h"
#include "tools/studio/server/checkpoints.h"

namespace forage::studio {

/// Checkpoints of a run at intervals, in bounded memory: when it is full, every second one is dropped and the
/// interval doubles. Checkpoints take at most a hundredth of the time.
class History {
  public:
    explicit History(std::size_t max_bytes = usual_bytes) : max_bytes_(max_bytes) {}

    /// An action that changed the run before the cycle with this number.
    struct Action {
        std::uint64_t cycle;
        nlohmann::json command;
        std::string title;
        void checkpoint(Archive& archive) {
            std::string text = command.dump();
            archive(cycle, text, title);
            if (archive.loading()) command = nlohmann::json::parse(text);
        }
    };

    /// Forgets everything and notes the state of a run that begins.
    void begin(Run& run) {
        checkpoints_.clear(), actions_.clear();
        next_action_ = 0, interval_ = first_interval, last_ = run.cycle(), rested_ = {};
        keep(run);
    }
    /// Called after each cycle.
    void after_cycle(Run& run) {
        const std::uint64_t cycle = run.cycle();
        if (cycle > last_) last_ = cycle;
        if (cycle % interval_ == 0 && !checkpoints_.contains(cycle)) keep(run);
    }
    /// Notes an action; what the run did later before it went back is forgotten.
    void act(std::uint64_t cycle, nlohmann::json command, std::string title) {
        cut(cycle);
        actions_.push_back({cycle, std::move(command), std::move(title)});
        next_action_ = actions_.size();
    }
    /// The next action that the run made before `cycle`, when it repeats its past; null when there is none.
    const Action* due(std::uint64_t cycle) {
        if (next_action_ >= actions_.size() || actions_[next_action_].cycle > cycle) return nullptr;
        return &actions_[next_action_++];
    }
    /// Restores the last checkpoint at or before `cycle`.
    void restore(Run& run, std::uint64_t cycle) {
        const std::uint64_t at = checkpoints_.last(cycle);
        const std::string bytes = checkpoints_.read(at);
        Archive archive{std::string_view(bytes)};
        run.checkpoint(archive);
        next_action_ = 0;
        while (next_action_ < actions_.size() && actions_[next_action_].cycle < at) ++next_action_;
    }
    /// Writes what is needed to come to `now` again in another program: the first checkpoint, the last one
    /// before `now`, and all actions.
    void save(Archive& archive, std::uint64_t now) {
        std::vector kept = {checkpoints_.first()};
        if (checkpoints_.last(now) != kept.front()) kept.push_back(checkpoints_.last(now));
        std::uint64_t count = kept.size();
        archive(count);  // of a map, whose strings are not in memory together
        for (std::uint64_t cycle : kept) {
            std::string bytes = checkpoints_.read(cycle);
            archive(cycle, bytes);
        }
        archive(actions_, last_);
    }
    /// Reads what save() wrote. restore() must follow.
    void load(Archive& archive) {
        std::map<std::uint64_t, std::string> kept;
        archive(kept, actions_, last_);
        if (kept.empty()) throw ArchiveError("the past of the run has no beginning");
        checkpoints_.clear(), interval_ = first_interval;
        for (auto& one : kept)  // a lambda of clang 14 captures no structured binding
            checkpoints_.add(one.first,
                             [&](Archive& out) { out.numbers(one.second.data(), one.second.size()); });
    }
    /// Whether continuing from `now` to `cycle` is shorter than from a checkpoint.
    bool ahead(std::uint64_t now, std::uint64_t cycle) const {
        return now <= cycle && checkpoints_.last(cycle) <= now;
    }

    std::uint64_t first() const { return checkpoints_.first(); }
    std::uint64_t last() const { return last_; }
    std::size_t bytes() const { return checkpoints_.bytes(); }
    std::size_t limit() const { return max_bytes_; }
    std::uint64_t interval() const { return interval_; }
    const std::vector<Action>& actions() const { return actions_; }
    std::vector<std::uint64_t> cycles() const { return checkpoints_.cycles(); }

  private:
    /// A browser's tab, whose addresses have 32 bits, has less memory.
    static constexpr std::size_t usual_bytes = (sizeof(void*) < 8 ? 64u : 256u) << 20;
    static constexpr std::uint64_t first_interval = 250;  ///< cycles: 10 s of the usual systems

    void keep(Run& run) {
        using Clock = std::chrono::steady_clock;
        const auto begun = Clock::now();
        if (begun < rested_ && run.cycle() > 0) return;
        checkpoints_.add(run.cycle(), [&](Archive& archive) { run.checkpoint(archive); });
        while (checkpoints_.bytes() > max_bytes_ && checkpoints_.size() > 2)
            checkpoints_.thin(), interval_ *= 2;
        const auto end = Clock::now();
        rested_ = end + 100 * (end - begun);
    }
    void cut(std::uint64_t cycle) {
        actions_.resize(std::min(next_action_, actions_.size()));
        checkpoints_.cut(cycle);
        last_ = std::min(last_, cycle);
    }

    Checkpoints checkpoints_;
    std::vector<Action> actions_;
    std::size_t next_action_ = 0, max_bytes_;
    std::uint64_t interval_ = first_interval, last_ = 0;
    std::chrono::steady_clock::time_point rested_{};  ///< when the next checkpoint may be made
};

}  // namespace forage::studio
