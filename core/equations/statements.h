// The lines of <Equations>, before their names have a meaning.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula.h"

namespace forage::equations {

/// A piece of the equations' text.
struct Piece {
    std::string text;
    std::size_t at = 0;  ///< where it begins in the equations
};

/// One equation: what is computed, and how.
struct Statement {
    enum class Kind {
        value,       ///< u = ...: a value of this cycle
        next,        ///< x' = ...: a state after this cycle
        derivative,  ///< dx/dt = ...
        output,      ///< output y = ..., or output y
        input,       ///< input velocity: a further input
    };
    Kind kind = Kind::value;
    std::string name;      ///< without prime, d and /dt
    std::size_t at = 0;    ///< where the name begins
    Piece formula;         ///< empty for `output y` and `input v`
    Piece condition;       ///< of `when`; else empty
    bool follows = false;  ///< whether it stands under the same `when` as the statement before
};

/// Whether equations can compute something of this name, and types declare it: not a word of theirs.
bool is_equation_name(std::string_view name);

/// A mistake at a place in the equations.
using Report = std::function<void(const FormulaError&)>;

/// Reads equations: a line for each, or several with ';' between them. A line ends where no parenthesis is
/// open; what follows '#' is a remark. Reports lines that are none, and leaves them out.
std::vector<Statement> read_statements(std::string_view text, const Report& report);

}  // namespace forage::equations
