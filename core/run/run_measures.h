// The numbers that a run of an experiment gives.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/model/experiment.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"

namespace forage {

/// Measures a run as an experiment file asks: the moments at which conditions first hold, quantities at the end, means over
/// trials.
class RunMeasures final : public Observer {
  public:
    /// Reports what cannot be measured. `trials`: whether the run has any.
    RunMeasures(std::span<const model::Measure> measures, const engine::Layout& layout, bool trials,
                Diagnostics& diagnostics);

    void declare(engine::Demand& demand) const override;
    /// Warns of conditions on cells that hold before the first cycle, when all cells are 0: they are probably mistakes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const override;
    void before_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override {
        for (auto& e : entries_) archive(e.first);
        archive(waiting_);
    }

    /// The measures at the end, in the experiment's order; empty where there is nothing to measure, or no number.
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
