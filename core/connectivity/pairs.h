// Patterns as lists of pairs of places.
#pragma once

#include <functional>

#include "core/connectivity/grid.h"
#include "core/model/pattern.h"

namespace forage::connectivity {

/// A place in a group; fractional where a population was projected onto a finer one.
struct Place {
    double x, y;
};

/// Calls `visit(source, target)` for each pair of the pattern, in order. Reports what the pattern cannot
/// mean.
void for_each_pair(const model::Pattern& pattern, const Grid& source, const Grid& target,
                   const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics);

/// No pattern has more pairs than this; counted without making them.
double most_pairs(const model::Pattern& pattern, const Grid& source, const Grid& target);

/// First and last whole coordinate of an extent of `size` around `centre`: from ceil(c - size/2) to
/// floor(c + size/2). An even size around a whole centre covers size + 1 cells.
struct Span {
    int first, last;
};
Span cover(double centre, double size);

}  // namespace forage::connectivity
