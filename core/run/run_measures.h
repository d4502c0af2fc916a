// The measures of a run of an experiment.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/model/experiment.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"

namespace forage {

/// Takes the measures of an experiment file: the cycles in which conditions first hold, quantities at the
/// end, and means over trials.
class RunMeasures final : public Observer {
  public:
    /// Reports measures that are impossible. `trials` says whether the run has trials.
    RunMeasures(std::span<const model::Measure> measures, const engine::Layout& layout, bool trials,
                Diagnostics& diagnostics);

    void declare(engine::Demand& demand) const override;
    /// Warns of conditions on cells that hold before the first cycle, when all cells are 0: they are probably
    /// mistakes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const override;
    void before_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override {
        for (auto& e : entries_) archive(e.first);
        archive(waiting_);
    }

    /// The measures at the end of the run, in the experiment's order. A value is empty when there is nothing
    /// to measure.
    std::vector<std::optional<double>> values(RunView& run);

  private:
    struct Entry {
        model::Measure spec;
        std::optional<observe::Condition> condition;
        std::optional<observe::Quantity> quantity;
        std::optional<double> first;  ///< the cycle before which the condition first held
    };
    std::vector<Entry> entries_;
    std::size_t waiting_ = 0;  ///< conditions that have not held yet
};

}  // namespace forage
