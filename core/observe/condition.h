// Conditions on a run, such as `trial >= 50 && Contextual/Stats(1,1) > 0.5`.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/observe/column.h"
#include "core/observe/sim_time.h"

namespace forage::observe {

/// A number that changes over a run: time, a cell, or a mean over cells.
struct Quantity {
    enum Kind { number, cycle, trial, seconds, cell, mean, sum, min, max } kind = number;
    double value = 0;  ///< of a number
    ColumnRef column;
    Index index = 0;  ///< of the cell

    double in(const engine::Simulation& simulation, const SimTime& now) const;
    /// Demands what it reads.
    void declare(engine::Demand& out) const;
};

/// A comparison of numbers, or several of them, joined by && and ||, or by `and` and `or`.
///
///     condition  = all { ( "||" | "or" ) all }
///     all        = comparison { ( "&&" | "and" ) comparison }
///     comparison = operand ("<" | "<=" | ">" | ">=" | "==" | "!=") operand | "(" condition ")"
///                | "cycle" NUMBER | "trial" NUMBER | NUMBER "s"        at that time and later
///     operand    = NUMBER | "cycle" | "trial" | "seconds" | cell
///                | ("mean" | "sum" | "min" | "max") "(" column ")"
///     cell       = column [ "(" x "," y ")" ]         without x and y: of a group of one cell
///     column     = Process/Group [ ":" state ]        the activity without a state
///
/// x and y count from 1. A column whose name contains one of <>=!&|(), " and " or " or " stands in double
/// quotes. Values of cells are those of the last cycle that was completed; before the first cycle they are 0.
class Condition {
  public:
    bool holds(const engine::Simulation& simulation, const SimTime& now) const {
        return holds(nodes_.size() - 1, simulation, now);
    }

    /// Whether it looks at cells, which are all 0 before the first cycle.
    bool sees_cells() const;
    /// Demands what it reads.
    void declare(engine::Demand& out) const;

  private:
    friend class ConditionParser;
    enum class Operator { less, at_most, more, at_least, equal, unequal, both, either };
    struct Node {
        Operator op = Operator::less;
        Quantity left, right;               ///< of a comparison
        std::size_t first = 0, second = 0;  ///< nodes, of `both` and `either`
    };
    bool holds(std::size_t node, const engine::Simulation& simulation, const SimTime& now) const;

    std::vector<Node> nodes_;  ///< parts before the whole
};

/// Reads a condition. Reports what it cannot be, with what there is; `what` says where the text stands
/// ("--schedule"). `trials`: whether the run has any.
std::optional<Condition> parse_condition(const engine::Layout& layout, bool trials, std::string_view text,
                                         std::string_view what, Diagnostics& diagnostics, Location at = {});

/// Reads an `operand` of the grammar of conditions.
std::optional<Quantity> parse_quantity(const engine::Layout& layout, bool trials, std::string_view text,
                                       std::string_view what, Diagnostics& diagnostics, Location at = {});

}  // namespace forage::observe
