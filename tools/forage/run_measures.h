// The numbers that a run of an experiment gives.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/model/experiment.h"
#include "core/observe/condition.h"
#include "tools/forage/load.h"

namespace forage::tool {

class RunMeasures {
  public:
    RunMeasures() = default;
    /// Measures of a system. Reports what cannot be measured.
    RunMeasures(std::span<const model::Measure> wishes, const Loaded& loaded, const engine::Layout& layout,
                Diagnostics& diagnostics);
    /// Warns of conditions on cells that hold before the first cycle, when all cells are 0: they are
    /// probably mistakes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const;

    /// Whether a condition has not held yet: only then there is something to see.
    bool waiting() const { return waiting_ > 0; }
    /// Before each cycle, and after the last.
    void see(const engine::Simulation& simulation, const observe::SimTime& now);

    /// At the end; empty where there is nothing to measure, or no number.
    std::vector<std::optional<double>> values(const Loaded& loaded, const engine::Simulation& simulation,
                                              const observe::SimTime& now) const;

    /// Demands what they read.
    void declare(engine::Demand& out) const;

    void checkpoint(Archive& archive) {
        for (auto& e : entries_) archive(e.first);
        archive(waiting_);
    }

  private:
    struct Entry {
        model::Measure wish;
        std::optional<observe::Condition> condition;
        std::optional<observe::Quantity> quantity;
        std::optional<double> first;  ///< the cycle before which the condition first held
    };
    std::vector<Entry> entries_;
    std::size_t waiting_ = 0;
};

}  // namespace forage::tool
