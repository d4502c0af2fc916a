// Connection plot: which cells of the source reach which cells of the target.
#pragma once

#include <string>
#include <vector>

#include "core/base/column.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

struct ConnectionPlot {
    std::string title, subtitle;
    std::string source, target;  ///< names of the groups
    GroupShape source_shape, target_shape;
    std::vector<int> pre, post;    ///< cells of each synapse, from 0
    std::vector<double> strength;  ///< what a synapse makes of activity 1
    std::vector<int> delay;        ///< cycles
};

/// A table of source cells against target cells in colours of the summed strength, and one of the longest
/// delay when there is any.
Picture connection_plot(const ConnectionPlot& plot);

}  // namespace forage::plot
