// Lines plot: means with their intervals, over a parameter or over trials.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/estimate.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

struct LinesPlot {
    struct Point {
        double x;
        std::optional<Estimate> y;  ///< empty: there is no number at this place
    };
    struct Line {
        std::string name;
        std::vector<Point> points;  ///< from left to right
    };
    std::string title, subtitle, x_title, y_title;
    std::vector<std::pair<double, std::string>> x_ticks;  ///< places and labels; empty: round numbers
    std::vector<Line> lines;
    std::optional<double> x_gap = {};  ///< where the x axis is broken, and the lines with it
};

/// Lines with a legend. Intervals are bars beside few points and bands around many. A line has a gap, and a
/// cross on the axis, where there is no number. The legend says which lines have no numbers at all. Among few
/// points, those of fewer numbers than the others have their number written beside them.
Picture lines_plot(const LinesPlot& plot);

}  // namespace forage::plot
