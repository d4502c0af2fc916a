// Lines plot: means with their intervals, over a parameter or over trials.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/canvas.h"

namespace forage::plot {

/// A mean, and the interval that holds the true one with 95 % confidence (Student's t).
struct Estimate {
    double mean = 0, low = 0, high = 0;
};
/// The estimate from independent numbers; empty when there are none. That of one number has no width.
std::optional<Estimate> estimate(const std::vector<double>& numbers);

struct LinesPlot {
    struct Point {
        double x;
        Estimate y;
    };
    struct Line {
        std::string name;
        std::vector<Point> points;  ///< from left to right
    };
    std::string title, subtitle, x_title, y_title;
    std::vector<std::pair<double, std::string>> x_ticks;  ///< places and labels; empty: round numbers
    std::vector<Line> lines;
};

/// Lines with a legend. Intervals are bars beside few points and bands around many.
Picture lines_plot(const LinesPlot& plot);

}  // namespace forage::plot
