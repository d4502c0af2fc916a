// Which heights things reach: they touch where they share some.
#pragma once

#include <utility>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "core/base/diagnostic.h"

namespace forage::bug {

/// The layers of Physics: a layer is a range of heights that some shape reaches over.
class Heights {
  public:
    /// The layer of what reaches from `low` to `high`, m; a new one when there is none yet. When there are
    /// too many, an error at `where`, once.
    int layer(double low, double high, const Location& where, Diagnostics& diagnostics);
    /// For each layer those that share heights with it.
    std::vector<LayerMask> meets() const;
    const std::vector<std::pair<double, double>>& ranges() const { return ranges_; }  ///< of each layer

  private:
    std::vector<std::pair<double, double>> ranges_;
    bool too_many_ = false;
};

}  // namespace forage::bug
