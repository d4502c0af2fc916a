// The language of expressions: sources, conditions, assignments, changes, manipulations and plots.
// docs/reference/expressions.md describes the grammar. These functions read syntax only, which needs no
// system; callers resolve the names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/model/pattern.h"

namespace forage::model {

/// A text in the language of expressions, and where it is written.
struct Expression {
    std::string text;
    Location at{};        ///< without a file: the command line
    Location value_at{};  ///< of an assignment whose value stands elsewhere in the file
    bool empty() const { return text.empty(); }
};

/// A change of a parameter, or of the world, while the system runs.
struct ScheduledChange {
    Expression when;    ///< a condition
    Expression change;  ///< "WHERE.parameter=value", "move NAME=X,Y" or "begin_trial"
    std::string text() const { return when.text + ": " + change.text; }
};

/// Patterns that change the activity of a group while the system runs.
struct ManipulationSpec {
    enum class Mode {
        clamp,     ///< the activity becomes the pattern
        add,       ///< the pattern is added to it
        multiply,  ///< it is multiplied by the pattern, cell by cell
    };
    static constexpr std::array<const char*, 3> modes = {"clamp", "add", "multiply"};
    static const char* name_of(Mode mode) { return modes[static_cast<std::size_t>(mode)]; }

    Mode mode = Mode::clamp;
    Expression group;     ///< "Process/Group"; empty for a table
    Expression cells;     ///< one pattern, "(x,y)=value ..."; alternative to `patterns` and `table`
    Expression patterns;  ///< a file of patterns, relative to the working directory
    Expression table;     ///< a file of rows cycle,process,group,v0,v1,... for any groups
    std::uint64_t every = 1, step = 1;  ///< a pattern every `every` cycles; only every `step`-th pattern
    std::optional<std::uint64_t> times = {};  ///< how often the list is played; empty for endlessly
    bool backwards = false;
    Expression from, until;  ///< conditions; empty: from the first cycle, until the last
    std::string text;        ///< the whole text, as written on the command line
};

}  // namespace forage::model

namespace forage::expression {

/// The error of a text that is not a valid expression. what() is the reason.
struct Mistake : std::invalid_argument {
    Mistake(std::size_t offset, const std::string& message, std::string advice)
        : std::invalid_argument(message), at(offset), hint(std::move(advice)) {}
    /// "'text', column 7: the reason; the hint", for callers without diagnostics.
    std::string described(std::string_view text) const;

    std::size_t at;    ///< the first wrong byte of the text, from 0
    std::string hint;  ///< may be empty
};

/// Where an expression is written, and where its mistakes are reported.
struct Context {
    std::string_view text;  ///< the whole expression
    std::string_view what;  ///< its purpose, which begins the messages: "--record", "measure"
    Diagnostics& diagnostics;
    Location at{};        ///< location of the first byte; without a file, the command line
    Location value_at{};  ///< as in model::Expression

    /// Where the byte `offset` of the text is.
    Location place(std::size_t offset) const;
    /// Reports a mistake at the byte `offset` of the text.
    void error(std::size_t offset, std::string message, std::string hint = {}) const;
    /// Parses the text. Reports a mistake, and returns nothing then.
    template <class T>
    std::optional<T> parsed(T (*parse)(std::string_view)) const {
        try {
            return parse(text);
        } catch (const Mistake& m) {
            error(m.at, m.what(), m.hint);
            return std::nullopt;
        }
    }
};

/// A piece of an expression.
struct Piece {
    std::string text;
    std::size_t at = 0;  ///< its first byte in the expression, from 0
};

/// What makes one number of the cells of a source: "max(Process/Group)".
inline constexpr std::string_view reductions[] = {"mean", "max"};

/// Cells of a column: "Process/Group:state(2..4,1)".
struct Source {
    Piece column;
    std::string_view reduction = {};  ///< "mean" or "max" of the cells; empty: each of them
    std::optional<model::Region> cells =
        {};                       ///< empty: all cells; a width or height of 0: an impossible range
    std::string cells_text = {};  ///< "(2..4,1)"
    std::size_t cells_at = 0;     ///< the first byte of `cells_text` in the expression

    /// The source in its canonical spelling: "mean:Process/Group:state(2..4,1)".
    std::string text() const {
        return std::string(reduction) + (reduction.empty() ? "" : ":") + column.text + cells_text;
    }
};

/// A number that is constant or changes during a run.
struct Quantity {
    enum Kind { number, cycle, trial, seconds, cell, mean, sum, min, max } kind = number;
    double value = 0;    ///< if `kind` is number
    Source source = {};  ///< used if `kind` is cell or a later kind
    std::size_t at = 0;  ///< its first byte in the expression
};

/// Comparisons of quantities, joined by `and` and `or`.
struct Condition {
    enum class Operator { less, at_most, more, at_least, equal, unequal, both, either };
    struct Node {
        Operator op;
        std::size_t first, second;  ///< indices into `quantities`, or into `nodes` if `op` is both or either
    };
    std::vector<Node> nodes;  ///< a tree: children before parents; the last node is the root
    std::vector<Quantity> quantities;
};

/// A parameter and its value: "WHERE.parameter=value".
struct Assignment {
    Piece owner, parameter, value;
};

/// A cell and its value: "(x,y)=value".
struct CellValue {
    Source cell;  ///< with an empty column
    double value;
};

/// A picture, as an expression describes it.
struct Plot {
    enum class Kind {
        time,
        space,
        movie,
        connection,
        diagram,
        trajectory,
        wiring,
        curve,
        heat,
        learning,
        occupancy
    };
    struct Cycles {
        std::uint64_t first, last, step;
        bool contains(std::uint64_t c) const { return c >= first && c <= last && (c - first) % step == 0; }
    };
    Kind kind = Kind::time;
    std::string what;  ///< the source, connection, process or measure; may be empty
    std::vector<Cycles> cycles;
    std::string cycles_text;  ///< the text after '@'
    int blocks_across = 1, blocks_down = 1;

    /// Whether the picture is made of rows of numbers. Those of a connection at given cycles are, too.
    bool of_cells() const {
        return kind == Kind::time || kind == Kind::space || kind == Kind::movie ||
               (of_connection() && !cycles.empty());
    }
    /// Whether the picture is drawn from the results of several runs or trials.
    bool of_results() const { return kind >= Kind::curve; }
    bool of_connection() const { return kind == Kind::connection || kind == Kind::wiring; }
    static std::string_view name(Kind kind);
};

/// The name and the value of an assignment, which the first '=' outside double quotes separates. Without one,
/// the text is the name.
struct NameAndValue {
    std::string_view name, value;
};
NameAndValue split_assignment(std::string_view text);

// Each function reads a whole text. All of them throw Mistake.
Source parse_source(std::string_view text);
Quantity parse_quantity(std::string_view text);
Condition parse_condition(std::string_view text);
Assignment parse_assignment(std::string_view text);
model::ScheduledChange parse_change(std::string_view text);
std::vector<CellValue> parse_cell_values(std::string_view text);
model::ManipulationSpec parse_manipulation(model::ManipulationSpec::Mode mode, std::string_view text);
Plot parse_plot(std::string_view text);

}  // namespace forage::expression
