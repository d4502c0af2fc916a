// Changes of parameters that wait for their moment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/edit.h"
#include "core/observe/condition.h"

namespace forage::observe {

class Schedule {
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

    bool waiting() const { return waiting_ > 0; }
    /// Before each cycle. Makes, in the order in which they were added, the changes whose condition holds for
    /// the first time: they act in the cycle to come. Throws what Simulation::set() throws.
    void apply(engine::Simulation& simulation, const SimTime& now);

    /// Reports what Simulation::check() finds wrong with the changes.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const;

    const std::vector<Entry>& entries() const { return entries_; }
    /// Demands what its conditions read.
    void declare(engine::Demand& out) const {
        for (const auto& e : entries_) e.when.declare(out);
    }

    /// What has acted.
    void checkpoint(Archive& archive) {
        for (auto& e : entries_) archive.same(e.text, "a change"), archive(e.cycle);
        archive(waiting_);
    }

  private:
    std::vector<Entry> entries_;
    std::size_t waiting_ = 0;
};

}  // namespace forage::observe
