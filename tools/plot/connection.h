// Connection plot: the synapses between the cells of two groups.
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
    std::vector<int> pre, post;    ///< source and target cell of each synapse, from 0
    std::vector<double> strength;  ///< the input that a synapse delivers for an activity of 1
    std::vector<int> delay;        ///< cycles
};

/// A matrix of source and target cells with the sum of the strengths in colours, and one with the longest
/// delays if there are delays.
Picture connection_plot(const ConnectionPlot& plot);

}  // namespace forage::plot
