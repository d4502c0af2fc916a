#include "tools/plot/figure.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"

namespace forage::plot {
namespace {

constexpr double panel_gap = 16, panel_letter_height = 22, panel_letter_size = 16;
constexpr double mm_per_inch = 25.4, dots_per_inch = 300, pixels_per_inch = 96;  // of print; of a canvas

}  // namespace

std::optional<FigureLayout> parse_layout(std::string_view text, Diagnostics& diagnostics) {
    const auto x = text.find('x');
    const auto rows = parse_number<int>(text.substr(0, x));
    const auto columns = x == text.npos ? std::nullopt : parse_number<int>(text.substr(x + 1));
    if (!rows || !columns || *rows < 1 || *columns < 1 || *rows > 26 || *columns > 26) {
        diagnostics.error({}, fmt::format("--layout '{}' is no layout of panels", text),
                          "write ROWSxCOLUMNS, for example 2x3, with at most 26 panels");
        return std::nullopt;
    }
    return FigureLayout{*rows, *columns};
}

Picture figure(std::vector<Picture> panels, const FigureLayout& layout) {
    const auto n = static_cast<std::size_t>(layout.columns);
    std::vector<double> widths(n, 0), heights(static_cast<std::size_t>(layout.rows), 0);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        widths[i % n] = std::max(widths[i % n], panels[i].width);
        heights[i / n] = std::max(heights[i / n], panels[i].height + panel_letter_height);
    }
    const auto sum = [](const std::vector<double>& sizes) {
        double out = -panel_gap;
        for (const double size : sizes)
            if (size > 0) out += size + panel_gap;  // an empty row takes no place
        return out;
    };
    return {sum(widths), sum(heights), [=, panels = std::move(panels)](Canvas& canvas) {
                cairo_t* c = canvas.cairo();
                double y = 0;
                for (std::size_t i = 0, row = 0; i < panels.size(); ++row) {
                    double x = 0;
                    for (std::size_t column = 0; column < n && i < panels.size(); ++column, ++i) {
                        canvas.text(x + 4, y + panel_letter_size, std::string(1, static_cast<char>('a' + i)),
                                    panel_letter_size, 0, black, true);
                        cairo_save(c);
                        cairo_translate(c, x, y + panel_letter_height);
                        panels[i].draw(canvas);
                        cairo_restore(c);
                        x += widths[column] + panel_gap;
                    }
                    y += heights[row] + panel_gap;
                }
            }};
}

std::optional<FigureWidth> parse_width(std::string_view text, Diagnostics& diagnostics) {
    FigureWidth out;
    std::string_view rest = text;
    if (rest.ends_with("mm"))
        rest.remove_suffix(2);
    else if (rest.ends_with("px"))
        rest.remove_suffix(2), out.in_pixels = true;
    const auto value = parse_number<double>(rest);
    const double min = out.in_pixels ? 40 : 10, max = out.in_pixels ? 20'000 : 2'000;
    if (!value || !(*value >= min && *value <= max)) {
        diagnostics.error({}, fmt::format("--width '{}' is no width of a figure", text),
                          "write 10mm to 2000mm, or 40px to 20000px");
        return std::nullopt;
    }
    out.value = *value;
    return out;
}

Picture scaled(const Picture& picture, const FigureWidth& width, Format format) {
    const double per_mm = (format == Format::png ? dots_per_inch : pixels_per_inch) / mm_per_inch;
    const double scale = width.value * (width.in_pixels ? 1 : per_mm) / picture.width;
    return {picture.width * scale, picture.height * scale, [picture, scale](Canvas& canvas) {
                cairo_save(canvas.cairo());
                cairo_scale(canvas.cairo(), scale, scale);
                picture.draw(canvas);
                cairo_restore(canvas.cairo());
            }};
}

}  // namespace forage::plot
