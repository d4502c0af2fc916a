// When a run is over, and how far it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/observe/condition.h"
#include "core/observe/observer.h"
#include "core/run/run_spec.h"

namespace forage {

/// Ends a run after a number of cycles, seconds or trials, or as soon as a condition holds.
class StopCondition {
  public:
    /// Reports lengths that make no sense in the run's environment, and what is wrong with the condition.
    static StopCondition make(const RunLength& length, const Run& run, Diagnostics& diagnostics);

    /// Cycles and trials that were over when the count began.
    struct Origin {
        std::uint64_t cycles = 0;
        std::size_t trials = 0;
    };
    /// Counts from now on, instead of from the start of the run.
    static Origin begin(const Run& run);

    bool reached(const Run& run, const Origin& origin) const;
    bool reached(const Run& run) const { return reached(run, Origin()); }  ///< counted from the start of the run
    /// Whether the condition holds.
    bool holds(const Run& run) const;
    /// Why a run ends before its length is reached: a trial took too long. Empty when the run may go on.
    std::string gives_up(const Run& run) const;
    double fraction_done(const Run& run) const;  ///< 0..1
    /// How far the run is, such as "12/30 trials, 11 at the target"; empty for a run without trials.
    std::string progress(const Run& run) const;
    /// Cycles after which the run ends; empty when trials end it.
    std::optional<std::uint64_t> cycles() const { return cycles_; }

    void declare(engine::Demand& demand) const {
        if (until_) until_->declare(demand);
    }

  private:
    RunLength length_;
    std::optional<std::uint64_t> cycles_;
    std::uint64_t timeout_ = 0;  ///< cycles
    std::optional<observe::Condition> until_;
};

}  // namespace forage
