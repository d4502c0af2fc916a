// Heat map: a measure over two parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/estimate.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

struct HeatMap {
    std::string title, subtitle, quantity;
    std::string x_title, y_title;
    std::vector<std::string> x_names, y_names;   ///< values of the parameters
    std::vector<std::optional<Estimate>> cells;  ///< row by row, from the first value of y; empty: no number
};

/// A coloured cell with its number for each pair of values; y grows upwards. Cells without a number have a
/// cross, and those of fewer numbers than the others say of how many, if they are large enough.
Picture heat_map(const HeatMap& map);

}  // namespace forage::plot
