// Wiring plot: the receptive field of each cell of a connection's target.
#pragma once

#include "tools/plot/connection.h"

namespace forage::plot {

struct WiringPlot : ConnectionPlot {
    std::string quantity = "strength";
    /// The cell at each position of a group, row by row; -1 where a sparse group has no cell.
    std::vector<int> source_places, target_places;
};

/// A panel for each target cell, laid out as the target. It shows the source, with the cells from which the
/// target cell receives input in the colour of their strength. Several plots stand one below the other, with
/// one scale. Throws std::runtime_error when the groups are too large.
Picture wiring_plot(const std::vector<WiringPlot>& plots);

}  // namespace forage::plot
