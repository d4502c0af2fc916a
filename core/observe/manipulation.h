// State manipulation: patterns that change the activity of a group.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/member_count.h"
#include "core/model/expression.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"

namespace forage::observe {

/// Applies a list of patterns to the activity of one group, right after the group's update: either one
/// pattern in every `every`-th cycle and none in between, or each pattern from a cycle of its own on.
class Manipulation final : public Observer {
  public:
    using Mode = model::ManipulationSpec::Mode;
    struct Settings {
        int group = 0;
        Mode mode = Mode::clamp;
        std::vector<std::vector<double>> patterns{};  ///< at least one; each has one value per cell
        /// For each pattern, the cycle from which on it is applied, until the next pattern is; in ascending
        /// order. Of several equal cycles, the last one counts. When empty, the patterns are played one after
        /// the other, according to the following members.
        std::vector<std::int64_t> starts{};
        std::uint64_t every = 1;                   ///< cycles from one pattern to the next
        std::uint64_t step = 1;                    ///< every `step`-th pattern of the list is used
        std::optional<std::uint64_t> times{};      ///< how often the list is played; empty for endlessly
        bool backwards = false;                    ///< from the last pattern to the first
        std::optional<Condition> from{}, until{};  ///< empty: from the first cycle, until the last
        /// Of a clamp, the cells that it sets, ascending; empty for all. The others are 0.
        std::vector<int> cells{};

        /// Reads or writes all settings but the conditions and cells, which only specifications have.
        void checkpoint(Archive& archive) {
            static_assert(member_count<Settings>() == 11);
            archive(group, mode, patterns, starts, every, step, times, backwards);
        }
    };
    explicit Manipulation(Settings settings);
    /// Makes this clamp act together with an earlier one of the same group: cells that neither sets are 0.
    /// after_groups() throws std::runtime_error when both set a cell in the same cycle.
    void join(const Manipulation& earlier) { earlier_ = &earlier; }
    const Settings& settings() const { return s_; }

    /// Begins and ends the manipulation when its conditions first hold.
    void before_cycle(RunView& run) override;
    void after_groups(RunView& run) override;
    void declare(engine::Demand& demand) const override;
    void checkpoint(Archive& archive) override { archive(begun_, over_, waited_, next_, played_); }

  private:
    void apply(RunView& run, const std::vector<double>& pattern);
    void clamp(RunView& run, const std::vector<double>& pattern);

    Settings s_;
    bool begun_ = false, over_ = false;
    std::uint64_t waited_ = 0;  ///< cycles since the last pattern
    std::size_t next_ = 0;  ///< position in playback; with `starts`, the number of patterns that have begun
    std::uint64_t played_ = 0;  ///< how often the list was played to its end
    const Manipulation* earlier_ = nullptr;
    std::optional<std::uint64_t> applied_;  ///< the cycle in which it has last clamped
};

}  // namespace forage::observe
