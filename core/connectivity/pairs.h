// Patterns as pairs of positions.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/connectivity/grid.h"
#include "core/model/pattern.h"

namespace forage::connectivity {

/// A position in a group. It is fractional when a population was projected onto a finer one.
struct Place {
    double x, y;
};

/// Calls `visit(source, target)` for each pair of the pattern, in order. Reports mistakes in the pattern.
void for_each_pair(const model::Pattern& pattern, const Grid& source, const Grid& target,
                   const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics);

/// An upper bound of the number of pairs of a pattern, computed without listing them.
double max_pairs(const model::Pattern& pattern, const Grid& source, const Grid& target);

/// The indices of the cells of a population in the order of for_each_pair(). Empty if there is something to
/// report about it.
std::optional<std::vector<int>> indices(const model::Population& population, const Grid& grid);

/// The first and last whole coordinate of an extent of `size` around `centre`: ceil(centre - size/2) and
/// floor(centre + size/2). An even size around a whole centre covers size + 1 cells.
struct Span {
    int first, last;
};
Span cover(double centre, double size);

}  // namespace forage::connectivity
