#include "tools/plot/canvas.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include "bug_interface/world/png.h"
#include "tools/plot/cairo_handle.h"
#include "tools/plot/gif.h"

namespace forage::plot {
namespace {

constexpr double points_per_pixel = 72.0 / 96.0;

cairo_status_t append(void* text, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(fmt::format("cannot draw: {}", cairo_status_to_string(status)));
}

void draw(const Picture& picture, cairo_surface_t* surface, double scale) {
    const CairoContext context(cairo_create(surface));
    cairo_scale(context.get(), scale, scale);
    Canvas canvas(context.get());
    canvas.colour(white);
    cairo_paint(context.get());
    picture.draw(canvas);
    check(cairo_status(context.get()));
}

/// Renumbers the ids in an SVG file. Cairo numbers them ("surface7", and from 1.18 on "source-7") with a
/// counter that continues from picture to picture. Here they are numbered in the order of their first
/// occurrence, so that a picture's bytes do not depend on earlier pictures. Glyphs, which have two numbers,
/// are counted per file.
std::string renumbered(const std::string& svg) {
    std::map<std::string, std::size_t> numbers;
    std::string out;
    std::size_t copied = 0;
    for (auto at = svg.find_first_of("i#"); at != svg.npos; at = svg.find_first_of("i#", at + 1)) {
        // After id=" or #, an id is letters and digits, with a quotation mark or a parenthesis behind it.
        if (svg[at] == 'i' && svg.compare(at, 4, "id=\"") != 0) continue;
        const auto id = at + (svg[at] == '#' ? 1 : 4);
        const auto digits = svg.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", id);
        const auto end = svg.find_first_not_of("0123456789", digits);
        if (end == svg.npos || digits == id || end == digits || (svg[end] != '"' && svg[end] != ')'))
            continue;
        out.append(svg, copied, digits - copied);
        out += std::to_string(numbers.emplace(svg.substr(id, end - id), numbers.size()).first->second);
        copied = at = end;
    }
    return out.append(svg, copied);
}

/// Both colour maps, and greys for the text.
std::vector<std::uint32_t> animation_colours() {
    const auto rgb = [](const Colour& c) {
        const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(255 * v)); };
        return byte(c.r) << 16 | byte(c.g) << 8 | byte(c.b);
    };
    constexpr int steps = 96, greys = 255 - 2 * steps;
    std::vector<std::uint32_t> out;
    for (int i = 0; i < steps; ++i) {
        const double fraction = static_cast<double>(i) / (steps - 1);
        out.push_back(rgb(sequential(fraction))), out.push_back(rgb(diverging(2 * fraction - 1)));
    }
    for (int i = 0; i < greys; ++i) {
        const double grey = static_cast<double>(i) / (greys - 1);
        out.push_back(rgb({grey, grey, grey}));
    }
    return out;
}

CairoSurface drawn(const Picture& picture) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                    static_cast<int>(std::ceil(picture.width)),
                                                    static_cast<int>(std::ceil(picture.height))));
    draw(picture, surface.get(), 1);
    return surface;
}

std::string png(const Picture& picture) {
    const CairoSurface surface = drawn(picture);
    const Pixels pixels = pixels_of(surface.get());
    std::vector<std::uint8_t> rgb(std::size_t(3) * std::size_t(pixels.width) * std::size_t(pixels.height));
    std::uint8_t* out = rgb.data();
    for (int row = 0; row < pixels.height; ++row)
        for (int column = 0; column < pixels.width; ++column, out += 3) {
            const auto pixel = pixels.rgb[std::size_t(row) * pixels.stride + std::size_t(column)];
            out[0] = static_cast<std::uint8_t>(pixel >> 16), out[1] = static_cast<std::uint8_t>(pixel >> 8),
            out[2] = static_cast<std::uint8_t>(pixel);
        }
    return bug::encode_png(pixels.width, pixels.height, rgb);
}

}  // namespace

std::optional<Format> format_of(std::string_view name) {
    for (const Format f : {Format::png, Format::svg, Format::pdf})
        if (name.size() > 4 && name.ends_with(ending(f))) return f;
    return std::nullopt;
}

std::string_view ending(Format format) {
    return format == Format::png ? ".png" : format == Format::svg ? ".svg" : ".pdf";
}

Canvas::Canvas(cairo_t* context) : c_(context) {
    // Glyph positions are not rounded to pixels, so that all formats look the same.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(c_, options);
    cairo_font_options_destroy(options);
}

void Canvas::dashes(double on, double off) {
    const double lengths[] = {on, off};
    cairo_set_dash(c_, lengths, on > 0 ? 2 : 0, 0);
}

void Canvas::stroke(const Colour& c, double width, double alpha) {
    colour(c, alpha);
    cairo_set_line_width(c_, width);
    cairo_stroke(c_);
}

void Canvas::circle(double x, double y, double radius) {
    cairo_new_sub_path(c_);
    cairo_arc(c_, x, y, radius, 0, 2 * M_PI);
}

void Canvas::segment(double x0, double y0, double x1, double y1) {
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
}

void Canvas::fill(double x, double y, double width, double height, const Colour& c) {
    cairo_rectangle(c_, x, y, width, height);
    fill(c);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& c, double width) {
    segment(x0, y0, x1, y1);
    stroke(c, width);
}

void Canvas::font(double size, bool bold) {
    cairo_select_font_face(c_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c_, size);
}

void Canvas::text(double x, double y, const std::string& what, double size, double anchor, const Colour& c,
                  bool bold) {
    font(size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(c_, what.c_str(), &extents);
    colour(c);
    cairo_move_to(c_, x - anchor * extents.x_advance, y);
    // Versions of cairo place letters at different fractions of a pixel, but filled outlines alike.
    if (cairo_surface_get_type(cairo_get_target(c_)) == CAIRO_SURFACE_TYPE_IMAGE) {
        cairo_text_path(c_, what.c_str());
        cairo_fill(c_);
    } else {
        cairo_show_text(c_, what.c_str());
    }
    cairo_new_path(c_);  // text leaves a current point, and an arc would be connected to it by a line
}

void Canvas::text_upwards(double x, double y, const std::string& what, double size) {
    cairo_save(c_);
    cairo_translate(c_, x, y);
    cairo_rotate(c_, -M_PI / 2);
    text(0, 0, what, size, 0.5);
    cairo_restore(c_);
}

double Canvas::width_of(const std::string& what, double size, bool bold) {
    font(size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(c_, what.c_str(), &extents);
    return extents.x_advance;
}

std::string Canvas::fitted(const std::string& what, double size, double width) {
    if (width_of(what, size) <= width) return what;
    std::string out = what;
    while (!out.empty() && width_of(out + "…", size) > width) {
        while ((static_cast<unsigned char>(out.back()) & 0xC0) == 0x80)
            out.pop_back();  // the rest of a multi-byte character
        out.pop_back();
    }
    return out + "…";
}

std::string Canvas::fitted_end(const std::string& what, double size, double width) {
    std::string out = what;
    for (std::size_t cut = 1; width_of(out, size) > width && cut < what.size(); ++cut)
        if ((static_cast<unsigned char>(what[cut]) & 0xC0) != 0x80) out = "…" + what.substr(cut);
    return out;
}

std::string render(const Picture& picture, Format format) {
    if (format == Format::png) return png(picture);
    std::string out;
    {
        const double w = picture.width * points_per_pixel, h = picture.height * points_per_pixel;
        const CairoSurface surface(format == Format::svg
                                       ? cairo_svg_surface_create_for_stream(append, &out, w, h)
                                       : cairo_pdf_surface_create_for_stream(append, &out, w, h));
        if (format == Format::pdf)  // the bytes must not depend on the time
            cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                           "2000-01-01T00:00:00Z");
        draw(picture, surface.get(), points_per_pixel);
        cairo_surface_finish(surface.get());
        check(cairo_surface_status(surface.get()));
    }
    return format == Format::svg ? renumbered(out) : out;
}

std::string render_animation(const std::vector<Picture>& frames, double seconds) {
    std::string out;
    GifFile gif(&out, seconds, animation_colours());
    for (const auto& frame : frames) {
        const CairoSurface surface = drawn(frame);
        gif.add(pixels_of(surface.get()));
    }
    gif.finish();
    return out;
}

Measure::Measure()
    : context_(
          [] {
              const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
              return cairo_create(surface.get());
          }(),
          DestroyCairo{}),
      canvas_(context_.get()) {}

}  // namespace forage::plot
