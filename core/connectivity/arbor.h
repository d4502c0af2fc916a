// Arborizations as lists of points around a centre.
#pragma once

#include <functional>

#include "core/connectivity/grid.h"
#include "core/connectivity/pairs.h"
#include "core/types/random.h"

namespace forage::connectivity {

/// Spreads around centres in one group.
class Arbor {
  public:
    /// `random` decides which points are kept (probability) and chosen (ArbRandom).
    Arbor(const model::Arborization& arborization, const Grid& grid, RandomStream random);

    /// Calls `visit(cell, distance)` for each point around `centre` that is a cell of the group: `cell` is its
    /// index, `distance` that of the point from the centre, in cells, before a cylinder wrapped it.
    void spread(Place centre, const std::function<void(int, double)>& visit);

  private:
    void points(Place centre, const std::function<void(int, int)>& visit);

    const model::Arborization& arborization_;
    const Grid& grid_;
    RandomStream random_;
    std::uint64_t draws_ = 0;
};

}  // namespace forage::connectivity
