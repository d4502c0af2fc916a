// Changes of the world in a schedule: "move Bug=0.5,-0.5" and "begin_trial Bug=0".
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "core/model/expression.h"

namespace forage::expression {

/// A robot or an object that gets another place: "move NAME=X,Y[,HEADING]".
struct Move {
    Piece name;
    double x, y;                    ///< m
    std::optional<double> heading;  ///< rad to the left of the x axis; its own when empty
};

/// A trial that ends, and the next one: "begin_trial [ROBOT][=START]".
struct NewTrial {
    Piece robot;                       ///< the first one when empty
    std::optional<std::size_t> start;  ///< number of a start pose, from 0; the next one when empty
};

using WorldChange = std::variant<Move, NewTrial>;

/// Reads a change of the world from a text that begins with the word "move" or "begin_trial". Returns nothing
/// when it begins with another word. Throws Mistake.
std::optional<WorldChange> parse_world_change(std::string_view text);

}  // namespace forage::expression
