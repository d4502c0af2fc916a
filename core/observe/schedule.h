// Changes of parameters that wait for their moment.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/edit.h"
#include "core/model/expression.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"

namespace forage::observe {

/// Changes parameters in the cycles in which their conditions first hold.
class Schedule final : public Observer {
  public:
    struct Entry {
        Condition when;
        model::Assignment change;
        std::string text;                    ///< as the user wrote it
        std::optional<std::uint64_t> cycle;  ///< the first in which it acted; empty: not yet
    };
    void add(Condition when, model::Assignment change, std::string text) {
        entries_.push_back({std::move(when), std::move(change), std::move(text), std::nullopt});
        ++waiting_;
    }

    const std::vector<Entry>& entries() const { return entries_; }

    void declare(engine::Demand& demand) const override {
        for (const auto& e : entries_) e.when.declare(demand);
    }
    /// Reports what Simulation::check() finds wrong with the changes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const override;
    /// Makes, in the order in which they were added, the changes whose condition holds for the first time: they act in the
    /// cycle to come. Throws what Simulation::set() throws.
    void before_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override {
        for (auto& e : entries_) archive.same(e.text, "a change"), archive(e.cycle);
        archive(waiting_);
    }

  private:
    std::vector<Entry> entries_;
    std::size_t waiting_ = 0;
};

/// Ties changes to a system. Reports what cannot be. `trials`: whether the run has any.
std::unique_ptr<Schedule> make_schedule(const std::vector<model::ScheduledChange>& changes,
                                        const model::System& system, const Registry& registry,
                                        const engine::Layout& layout, bool trials, Diagnostics& diagnostics);

}  // namespace forage::observe
