// Arborizations as lists of points around a centre.
#pragma once

#include <functional>
#include <vector>

#include "core/connectivity/grid.h"
#include "core/connectivity/pairs.h"
#include "core/base/random.h"

namespace forage::connectivity {

/// Spreads around centres in one group.
class Arbor {
  public:
    /// `random` decides which points are kept (probability) and chosen (ArbRandom).
    Arbor(const model::Arborization& arborization, const Grid& grid, RandomStream random);

    /// Calls `visit(cell, distance)` for each point around `centre` that is a cell of the group: `cell` is
    /// its index, `distance` that of the point from the centre, in cells, before a cylinder wrapped it.
    void spread(Place centre, const std::function<void(int, double)>& visit);

    /// No centre has more points than this that can be cells of the group; counted without making them.
    double most_points() const;

  private:
    using PointVisitor = std::function<void(int, int)>;
    void points(Place centre, const PointVisitor& visit);
    void rectangle(Place centre, int width, int height, const PointVisitor& visit) const;
    void ellipse(Place centre, int width, int height, const PointVisitor& visit) const;

    const model::Arborization& arborization_;
    const Grid& grid_;
    RandomStream random_;
    std::uint64_t draws_ = 0;
    Span reach_x_, reach_y_;   ///< where a point can be a cell, directly or over the seam of a cylinder
    std::vector<int> places_;  ///< of ArbRandom: all places, in the order that the draws have left
};

}  // namespace forage::connectivity
