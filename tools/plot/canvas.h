// The drawing surface of all pictures, and their file formats.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <cairo.h>

#include "tools/plot/colours.h"

namespace forage::plot {

enum class Format { png, svg, pdf };

/// The format of a file name that ends with ".png", ".svg" or ".pdf"; empty for other names.
std::optional<Format> format_of(std::string_view name);
/// The end of file names: ".png", ".svg" or ".pdf".
std::string_view ending(Format format);

/// The functions of cairo that pictures need. The unit is a pixel of a PNG file, 1/96 inch; y points
/// downwards.
class Canvas {
  public:
    explicit Canvas(cairo_t* context);

    cairo_t* cairo() const { return c_; }
    void colour(const Colour& c, double alpha = 1) { cairo_set_source_rgba(c_, c.r, c.g, c.b, alpha); }
    /// Draws lines with dashes of the length `on` and gaps of the length `off`, until both are set to 0.
    void dashes(double on, double off);
    /// Draws the path of cairo(), and ends it.
    void stroke(const Colour& c, double width = 1, double alpha = 1);
    void fill(const Colour& c, double alpha = 1) { colour(c, alpha), cairo_fill(c_); }
    /// Adds a circle, or a line, to the path.
    void circle(double x, double y, double radius);
    void segment(double x0, double y0, double x1, double y1);
    void fill(double x, double y, double width, double height, const Colour& c);
    void line(double x0, double y0, double x1, double y1, const Colour& c, double width = 1);
    /// Draws a text. `anchor` is 0 when the text starts at x, 0.5 when it is centred at x, 1 when it ends at
    /// x. y is the base line.
    void text(double x, double y, const std::string& what, double size, double anchor = 0,
              const Colour& c = black, bool bold = false);
    /// Draws text that runs upwards, centred at (x, y).
    void text_upwards(double x, double y, const std::string& what, double size);
    /// The width of a text.
    double width_of(const std::string& what, double size, bool bold = false);
    /// The text `what`; its end is replaced by an ellipsis when it is wider than `width`.
    std::string fitted(const std::string& what, double size, double width);
    /// The text `what`; its beginning is replaced by an ellipsis when it is wider than `width`.
    std::string fitted_end(const std::string& what, double size, double width);

  private:
    void font(double size, bool bold);
    cairo_t* c_;
};

/// A picture: its size and a function that draws it. It can be drawn several times, on any surface.
struct Picture {
    double width = 0, height = 0;
    std::function<void(Canvas&)> draw;
};

/// The content of a file with the picture. The same picture gives the same bytes. Throws std::runtime_error
/// when cairo fails.
std::string render(const Picture& picture, Format format);

/// The content of an animated GIF that shows each picture for `seconds` and repeats forever. Throws
/// std::runtime_error when cairo fails or the pictures differ in size.
std::string render_animation(const std::vector<Picture>& frames, double seconds);

/// A canvas that measures text before the size of the picture is known.
class Measure {
  public:
    Measure();
    Canvas& canvas() { return *canvas_; }

  private:
    std::shared_ptr<cairo_t> context_;
    std::optional<Canvas> canvas_;
};

}  // namespace forage::plot
