// Which cells of the source a connection pairs with which cells of the target.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/base/array.h"
#include "core/base/diagnostic.h"
#include "core/model/number_formula.h"

namespace forage::model {

/// The position of a cell in its group: x to the right, y downwards, both from 1.
struct Point {
    int x = 1, y = 1;
    Location at;
    friend bool operator==(const Point&, const Point&) = default;
};

/// Every cell of the group.
struct All {
    friend bool operator==(const All&, const All&) = default;
};

/// A rectangle of cells; (x, y) is its upper left cell, from 1.
struct Region {
    int x = 1, y = 1, width = 1, height = 1;
    Location at;
    Formulas<Region> formulas = {};
    friend bool operator==(const Region&, const Region&) = default;
};

/// Single cells.
struct List {
    std::vector<Point> points;
    Location at;
    friend bool operator==(const List&, const List&) = default;
};

using Population = std::variant<All, Region, List>;

/// Scales the smaller population to the size of the larger one. Each of its cells is paired with the position
/// onto which it is projected.
struct MappedPattern {
    /// Whether to pair with every cell under the projected rectangle, not only with its centre.
    bool all = false;
    Population source, target;
    bool is_stated = false;  ///< whether the file says "center" or "all"; not compared
    friend bool operator==(const MappedPattern& a, const MappedPattern& b) {
        return a.all == b.all && a.source == b.source && a.target == b.target;
    }
};

/// Pairs every source cell with every target cell.
struct ForeachPattern {
    Population source, target;
    friend bool operator==(const ForeachPattern&, const ForeachPattern&) = default;
};

/// Pairs every source with every target of the same tuple. Duplicate pairs are kept.
struct TuplesPattern {
    struct Tuple {
        std::vector<Point> sources, targets;
        friend bool operator==(const Tuple&, const Tuple&) = default;
    };
    std::vector<Tuple> tuples;
    friend bool operator==(const TuplesPattern&, const TuplesPattern&) = default;
};

/// A synapse for each number of a table, which is its weight: a matrix with a row for each target cell and a
/// column for each source cell, or a list of source, target, weight and perhaps delay, with cells from 0.
struct Weights {
    std::string file = {};  ///< from the folder of the system's file; empty when `text` has the numbers
    bool is_list = false;
    std::string text = {};
    Location at = {}, file_at = {}, text_at = {};
    ArrayHandle array = {};
    friend bool operator==(const Weights&, const Weights&) = default;
};

using Pattern = std::variant<MappedPattern, ForeachPattern, TuplesPattern, Weights>;

}  // namespace forage::model
