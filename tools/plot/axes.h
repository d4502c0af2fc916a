// Axes, ticks and colour bars: what makes a picture's numbers readable.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/plot/canvas.h"

namespace forage::plot {

struct Interval {
    double low = 0, high = 1;
    double size() const { return high - low; }
};

/// Multiples of a round step within an interval, and their names.
class Ticks {
  public:
    /// About `count` of them; of whole numbers only when `whole`.
    Ticks(Interval interval, int count, bool whole = false);
    const std::vector<double>& at() const { return at_; }
    std::string name(double value) const;

  private:
    double step_;
    std::vector<double> at_;
};

/// A rectangle on the canvas.
struct Box {
    double x = 0, y = 0, width = 0, height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
};

/// A box whose points are values: x to the right, y upwards, or downwards as cells are numbered.
struct Axes {
    Box box;
    Interval x, y;
    bool y_down = false;
    double px(double v) const { return box.x + (v - x.low) / x.size() * box.width; }
    double py(double v) const {
        const double part = (v - y.low) / y.size();
        return box.y + (y_down ? part : 1 - part) * box.height;
    }
};

struct AxisStyle {
    std::string title;
    bool whole = false;  ///< ticks at whole numbers only
    bool named = true;   ///< ticks have their numbers
};

/// Frame, ticks with numbers, and titles.
void draw_axes(Canvas& canvas, const Axes& axes, const AxisStyle& x, const AxisStyle& y);

/// What colour a value has: blue to yellow between the smallest and largest value, zero included; blue over
/// white to red, with zero in the middle, when there are values below zero. Values that are no numbers are
/// grey.
class ColourScale {
  public:
    void include(double value);
    Colour operator()(double value) const;
    Interval interval() const;
    Colour at(double part) const;  ///< of the bar, 0..1

  private:
    double low_ = 0, high_ = 0;
};

/// A bar with ticks and, beside it, what it shows.
void draw_colour_bar(Canvas& canvas, const ColourScale& scale, const Box& box, const std::string& title);
/// What a colour bar takes to the right of its box.
inline constexpr double colour_bar_labels = 78;

/// A rectangle of `columns` x `rows` cells of one colour each.
void draw_cells(Canvas& canvas, const Box& box, int columns, int rows,
                const std::function<Colour(int column, int row)>& colour);

}  // namespace forage::plot
