// The surface that every picture is drawn on, and the formats it can be written in.
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

/// The format that ".png", ".svg" or ".pdf" at the end of a name asks for; empty for other names.
std::optional<Format> format_of(std::string_view name);
/// ".png", ".svg", ".pdf"
std::string_view ending(Format format);

/// What the pictures need of cairo, in units of 1/96 inch: a pixel of a PNG. y points downwards.
class Canvas {
  public:
    explicit Canvas(cairo_t* context);

    cairo_t* cairo() const { return c_; }
    void colour(const Colour& c, double alpha = 1) { cairo_set_source_rgba(c_, c.r, c.g, c.b, alpha); }
    /// Of lines from now on, until they are 0 and 0: lengths drawn and left out.
    void dashes(double on, double off);
    void fill(double x, double y, double width, double height, const Colour& c);
    void line(double x0, double y0, double x1, double y1, const Colour& c, double width = 1);
    /// `anchor` 0: starts at x; 0.5: centred; 1: ends at x. y is the base line.
    void text(double x, double y, const std::string& what, double size, double anchor = 0,
              const Colour& c = black, bool bold = false);
    /// Text that reads upwards, centred at (x, y).
    void text_upwards(double x, double y, const std::string& what, double size);
    double width_of(const std::string& what, double size, bool bold = false);
    /// `what`, with its end replaced by an ellipsis when it is wider than `width`.
    std::string fitted(const std::string& what, double size, double width);

  private:
    void font(double size, bool bold);
    cairo_t* c_;
};

/// A picture: how large it is, and how it is drawn. It can be drawn several times, onto any surface.
struct Picture {
    double width = 0, height = 0;
    std::function<void(Canvas&)> draw;
};

/// The picture as the content of a file; the same picture gives the same bytes. Throws std::runtime_error.
std::string render(const Picture& picture, Format format);

/// The pictures, all of the first one's size, as an animated PNG that shows each for `seconds` and repeats
/// for ever. Viewers that know no animation show the first. Throws std::runtime_error.
std::string render_animation(const std::vector<Picture>& frames, double seconds);

/// A context to measure text with before a picture's size is known.
class Measure {
  public:
    Measure();
    Canvas& canvas() { return *canvas_; }

  private:
    std::shared_ptr<cairo_t> context_;
    std::optional<Canvas> canvas_;
};

}  // namespace forage::plot
