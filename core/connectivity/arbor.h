// Arborizations as points around a centre.
#pragma once

#include <functional>
#include <vector>

#include "core/base/random.h"
#include "core/connectivity/grid.h"
#include "core/connectivity/pairs.h"

namespace forage::connectivity {

/// The arborization of a connection in one group, around any centre.
class Arbor {
  public:
    /// `random` decides which points are kept (probability) and drawn (ArbRandom).
    Arbor(const model::Arborization& arborization, const Grid& grid, RandomStream random);

    /// Calls `visit(cell, distance)` for each point around `centre` that is a cell of the group. `cell` is
    /// the index of the cell; `distance` is the distance between the point and the centre, in cells, before
    /// the point is wrapped around a cylinder.
    void spread(Place centre, const std::function<void(int, double)>& visit);

    /// An upper bound on the number of cells around any centre, computed without listing them. `whole` says
    /// that all centres are cells, not places between them.
    double max_points(bool whole) const;

  private:
    using PointVisitor = std::function<void(int, int)>;
    void points(Place centre, const PointVisitor& visit);
    void rectangle(Place centre, int width, int height, const PointVisitor& visit) const;
    void ellipse(Place centre, int width, int height, const PointVisitor& visit) const;

    const model::Arborization& arborization_;
    const Grid& grid_;
    RandomStream random_;
    std::uint64_t draws_ = 0;
    /// Coordinates at which a point can be a cell, directly or across the seam of a cylinder.
    Span reach_x_, reach_y_;
    /// All positions, in the order in which earlier draws have left them; used for ArbRandom only.
    std::vector<int> places_;
};

}  // namespace forage::connectivity
