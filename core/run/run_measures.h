// The measures of a run of an experiment.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/formula/formula.h"
#include "core/model/experiment.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"
#include "core/run/robot_measure.h"

namespace forage {

/// Takes the measures of an experiment file: when, how long and in how many trials conditions hold,
/// quantities at the end and over all cycles, means over trials, and what robots do.
class RunMeasures final : public Observer {
  public:
    /// Reports measures that are impossible. `environment` is that of the run; null when it has none.
    RunMeasures(std::span<const model::Measure> measures, const engine::Layout& layout,
                Environment* environment, Diagnostics& diagnostics);

    /// The measures as they were given.
    std::vector<model::Measure> specs() const;
    void declare(engine::Demand& demand) const override;
    /// Warns of conditions on cells that hold before the first cycle, when all cells are 0: they are probably
    /// mistakes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const override;
    void before_cycle(RunView& run) override;
    void after_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override;

    /// The measures at the end of the run, in the experiment's order. A value is empty when there is nothing
    /// to measure.
    std::vector<std::optional<double>> values(RunView& run);

  private:
    struct Entry {
        model::Measure spec;
        std::optional<observe::Condition> condition;
        std::optional<Formula> formula;
        std::optional<observe::Quantity> quantity;
        std::optional<RobotMeasure> robot;
        std::optional<double> first;  ///< the cycle before which the condition first held
        std::uint64_t cycles = 0;     ///< how often the condition has held, without resets
        std::uint64_t checked = 0;    ///< of a share: how often it was checked
        int trials = 0;               ///< in how many trials
        int last_trial = 0;           ///< the last of these trials
        std::uint64_t values = 0;     ///< how often the quantity was read, with its sum and its extremes
        double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    };
    /// Reads the formula of a measure, which uses the measures before it. Reports mistakes.
    void read_formula(Entry& entry, Diagnostics& diagnostics) const;
    /// The value of a measure, of which formulas use the `known` ones before it.
    std::optional<double> value(Entry& entry, RunView& run,
                                std::span<const std::optional<double>> known) const;

    std::vector<Entry> entries_;
    /// Conditions that have to be checked: those that are counted, and the others until they hold.
    std::size_t waiting_ = 0;
    bool follows_ = false;  ///< whether a quantity or a robot is followed through all cycles
};

}  // namespace forage
