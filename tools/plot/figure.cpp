#include "tools/plot/figure.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"

namespace forage::plot {
namespace {

constexpr double panel_gap = 16, panel_letter_height = 22, panel_letter_size = 16, pixels_per_mm = 96 / 25.4;

}  // namespace

std::optional<FigureLayout> parse_layout(std::string_view text, double width_mm, Diagnostics& diagnostics) {
    const auto x = text.find('x');
    const auto rows = parse_number<int>(text.substr(0, x));
    const auto columns = x == text.npos ? std::nullopt : parse_number<int>(text.substr(x + 1));
    if (!rows || !columns || *rows < 1 || *columns < 1 || *rows > 26 || *columns > 26) {
        diagnostics.error({}, fmt::format("--layout '{}' is no layout of panels", text),
                          "write ROWSxCOLUMNS, for example 2x3, with at most 26 panels");
        return std::nullopt;
    }
    return FigureLayout{*rows, *columns, width_mm > 0 ? std::optional(width_mm) : std::nullopt};
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
    const double width = sum(widths), height = sum(heights);
    const double scale = layout.width_mm ? *layout.width_mm * pixels_per_mm / width : 1;
    return {width * scale, height * scale, [=, panels = std::move(panels)](Canvas& canvas) {
                cairo_t* c = canvas.cairo();
                cairo_save(c);
                cairo_scale(c, scale, scale);
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
                cairo_restore(c);
            }};
}

}  // namespace forage::plot
