// The layers of Physics: ranges of heights. Shapes can touch only where they share heights.
#pragma once

#include <utility>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// Assigns layers to shapes. A layer is a range of heights over which some shape extends.
class Heights {
  public:
    /// The layer of a shape that extends from `low` to `high` (m); a new one when no layer has this range.
    /// Reports an error at `where` the first time that there are more than max_layers.
    int layer(double low, double high, const Location& where, Diagnostics& diagnostics);
    /// The mask of each layer: the layers that share at least 1 mm of heights with it.
    std::vector<LayerMask> collision_masks() const;
    /// The lower and the upper limit of each layer, m.
    const std::vector<std::pair<double, double>>& ranges() const { return ranges_; }

  private:
    std::vector<std::pair<double, double>> ranges_;
    bool too_many_ = false;
};

}  // namespace forage::bug
