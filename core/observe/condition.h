// Conditions on a run, such as `trial >= 50 && Contextual/Stats(1,1) > 0.5`.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/observe/sim_time.h"
#include "core/observe/source.h"

namespace forage::observe {

/// A number: a constant, the time, a cell, or the mean, sum, minimum or maximum of cells.
struct Quantity {
    using Kind = expression::Quantity::Kind;
    Kind kind = Kind::number;
    double value = 0;  ///< if `kind` is number
    Source source;     ///< used if `kind` is cell or a later kind

    /// The value between two cycles. Cells have the values of the last completed cycle, and 0 before the
    /// first.
    double in(const engine::Simulation& simulation, const SimTime& now) const;
    bool sees_cells() const { return kind >= Kind::cell; }
    /// Demands the columns that are read.
    void declare(engine::Demand& out) const {
        if (sees_cells()) source.declare(out);
    }
};

/// Comparisons of quantities, joined by `and` and `or`.
class Condition {
  public:
    bool holds(const engine::Simulation& simulation, const SimTime& now) const {
        return holds(nodes_.back(), simulation, now);
    }

    /// A point in time: a cycle, counted from 0, or a trial, counted from 1.
    struct TimePoint {
        bool in_trials = false;
        double number = 0;
        bool at_start() const { return number <= (in_trials ? 1 : 0); }
    };
    /// The time from which on the condition holds, when it depends on nothing but the time: "cycle 100",
    /// "30 s", "cycle > 5 and cycle >= 8". Empty for other conditions.
    std::optional<TimePoint> begin(double seconds_per_cycle) const {
        return begin(nodes_.back(), seconds_per_cycle);
    }

    /// Whether the condition reads cells, which are all 0 before the first cycle.
    bool sees_cells() const;
    /// Demands the columns that are read.
    void declare(engine::Demand& out) const {
        for (const auto& q : quantities_) q.declare(out);
    }

  private:
    using Node = expression::Condition::Node;
    friend std::optional<Condition> parse_condition(const engine::Layout&, bool, std::string_view,
                                                    std::string_view, Diagnostics&, Location);
    bool holds(const Node& node, const engine::Simulation& simulation, const SimTime& now) const;
    std::optional<TimePoint> begin(const Node& node, double seconds_per_cycle) const;

    std::vector<Node> nodes_;
    std::vector<Quantity> quantities_;
};

/// Reads a condition. Reports mistakes; `what` begins the messages ("--schedule"). `trials` says whether the
/// run has trials.
std::optional<Condition> parse_condition(const engine::Layout& layout, bool trials, std::string_view text,
                                         std::string_view what, Diagnostics& diagnostics, Location at = {});

/// Reads a quantity. The parameters are those of parse_condition().
std::optional<Quantity> parse_quantity(const engine::Layout& layout, bool trials, std::string_view text,
                                       std::string_view what, Diagnostics& diagnostics, Location at = {});

}  // namespace forage::observe
