// Axes, ticks and colour bars.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/canvas.h"

namespace forage::plot {

struct Interval {
    double low = 0, high = 1;
    double size() const { return high - low; }
};

/// The multiples of a round step within an interval, and their labels.
class Ticks {
  public:
    /// Makes about `count` ticks; only whole numbers if `whole` is set.
    Ticks(Interval interval, int count, bool whole = false);
    const std::vector<double>& at() const { return at_; }
    /// The label of a tick.
    std::string name(double value) const;

  private:
    double step_;
    std::vector<double> at_;
};

/// A moment of a run: "12.4 s (cycle 310)". Only the cycle when the time of a cycle is not known, or 0.
std::string moment_text(std::uint64_t cycle, double seconds_per_cycle);

/// A rectangle on the canvas.
struct Box {
    double x = 0, y = 0, width = 0, height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
};

/// A box with coordinates: x to the right, and y upwards, or downwards if `y_down` is set.
struct Axes {
    Box box;
    Interval x, y;
    bool y_down = false;
    double px(double v) const { return box.x + (v - x.low) / x.size() * box.width; }
    double py(double v) const {
        const double fraction = (v - y.low) / y.size();
        return box.y + (y_down ? fraction : 1 - fraction) * box.height;
    }
};

/// Draws the title of a picture and, below it, a subtitle.
void draw_titles(Canvas& canvas, const std::string& title, const std::string& subtitle);
/// The width that the titles of a picture need.
double width_of_titles(Canvas& canvas, const std::string& title, const std::string& subtitle);

/// Restricts what is drawn to a box, until cairo_restore().
void clip(Canvas& canvas, const Box& box);
/// Draws a line around a box.
void draw_frame(Canvas& canvas, const Box& box, const Colour& colour);

struct AxisStyle {
    std::string title;
    bool whole = false;                                      ///< whether ticks are only at whole numbers
    bool named = true;                                       ///< whether ticks have labels
    std::vector<std::pair<double, std::string>> ticks = {};  ///< places and labels, instead of round numbers
};

/// Ticks with the names of things that are numbered from `first` on. Neighbours of the same name share one.
std::vector<std::pair<double, std::string>> name_ticks(const std::vector<std::string>& names, double first);
/// The same with the numbers of the neighbours in front: "1-2 red".
std::vector<std::pair<double, std::string>> numbered_ticks(const std::vector<std::string>& names, int first);

/// Draws the frame, the ticks with labels, and the titles.
void draw_axes(Canvas& canvas, const Axes& axes, const AxisStyle& x, const AxisStyle& y);

/// Maps values to colours. If all values are at least 0, the colours go from blue to yellow between 0 and the
/// largest value. Otherwise they go from blue over white to red, with white at 0. Values that are not finite
/// are grey.
class ColourScale {
  public:
    /// Extends the scale to a value.
    void include(double value);
    Colour operator()(double value) const;
    Interval interval() const;
    Colour at(double fraction) const;  ///< the colour at a fraction of the colour bar, 0..1

  private:
    double low_ = 0, high_ = 0;
};

/// Draws a colour bar with ticks and a title beside it.
void draw_colour_bar(Canvas& canvas, const ColourScale& scale, const Box& box, const std::string& title);
/// The width of the ticks and the title to the right of a colour bar's box.
inline constexpr double colour_bar_labels = 78;

/// The size of the cells of a table in pixels.
struct CellSize {
    int width, height;
};
/// Squares of at most `largest` pixels with which a table fits into a room, or, in a table of which a side
/// would be shorter than `least` pixels, rectangles.
CellSize cell_size(int columns, int rows, int room_x, int room_y, int largest, int least);

/// Draws a rectangle of `columns` x `rows` cells, each with a uniform colour.
void draw_cells(Canvas& canvas, const Box& box, int columns, int rows,
                const std::function<Colour(int column, int row)>& colour);

}  // namespace forage::plot
