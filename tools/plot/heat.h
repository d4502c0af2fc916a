// Heat map: a measure over two parameters.
#pragma once

#include <string>
#include <vector>

#include "tools/plot/canvas.h"

namespace forage::plot {

struct HeatMap {
    std::string title, subtitle, quantity;
    std::string x_title, y_title;
    std::vector<std::string> x_names, y_names;  ///< values of the parameters
    std::vector<double> numbers;                ///< row by row, from the first value of y; NaN: unknown
};

/// A coloured cell with its number for each pair of values; y grows upwards.
Picture heat_map(const HeatMap& map);

}  // namespace forage::plot
