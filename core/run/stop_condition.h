// The end of a run, and its progress.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/observe/condition.h"
#include "core/observe/observer.h"
#include "core/run/run_spec.h"

namespace forage {

/// The numbers of completed cycles and trials at the time from which the length of a run is counted.
struct StopOrigin {
    std::uint64_t cycles = 0;
    std::size_t trials = 0;
};

/// Ends a run after a number of cycles, seconds or trials, or as soon as a condition holds.
class StopCondition {
  public:
    /// Reports lengths that are impossible in the run's environment, and mistakes in the condition.
    static StopCondition make(const RunLength& length, const Run& run, Diagnostics& diagnostics);

    using Origin = StopOrigin;
    /// The origin that counts from now on, instead of from the start of the run.
    static Origin begin(const Run& run);

    bool reached(const Run& run, const Origin& origin) const;
    /// Whether the run has reached its length, counted from the start of the run.
    bool reached(const Run& run) const { return reached(run, Origin()); }
    /// Whether the condition holds.
    bool holds(const Run& run) const;
    /// The reason for an early end: a trial took too long. Empty when the run may continue.
    std::string timeout_reason(const Run& run) const;
    double fraction_done(const Run& run, const Origin& origin = {}) const;  ///< 0..1; 0 without a length
    /// The progress in words, such as "12/30 trials, 11 at the target"; empty for a run without trials.
    std::string progress(const Run& run) const;
    /// The number of cycles after which the run ends; empty when trials end it.
    std::optional<std::uint64_t> cycles() const { return cycles_; }
    /// By how many cycles they are longer than the seconds that were given, and those of the length before.
    double overrun() const { return overrun_; }

    void declare(engine::Demand& demand) const {
        if (until_) until_->declare(demand);
    }

  private:
    RunLength length_;
    std::optional<std::uint64_t> cycles_;
    double overrun_ = 0;
    std::uint64_t timeout_ = 0;  ///< cycles
    std::optional<observe::Condition> until_;
};

}  // namespace forage
