// Several pictures as the panels of one figure, and the widths of figures.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

inline constexpr std::size_t max_panels_of_figure = 26;  ///< the letters of the alphabet

/// The places of a figure's panels.
struct FigureLayout {
    int rows = 1, columns = 1;
};

/// Reads "ROWSxCOLUMNS", such as "2x3". Reports mistakes. Empty when there was one.
std::optional<FigureLayout> parse_layout(std::string_view text, Diagnostics& diagnostics);

/// The panels row by row, each with a letter at its upper left: a, b, c, ... A column is as wide as its
/// widest panel, and a row as high as its highest one. There are no more panels than places, and at most 26.
Picture figure(std::vector<Picture> panels, const FigureLayout& layout);

/// The width of a picture in its file.
struct FigureWidth {
    double value = 0;
    bool in_pixels = false;  ///< of 1/96 inch in SVG and PDF; otherwise mm
};

/// Reads "85mm", "85" (mm) or "600px". Reports mistakes. Empty when there was one.
std::optional<FigureWidth> parse_width(std::string_view text, Diagnostics& diagnostics);

/// The picture, enlarged or reduced to this width. A PNG file of a width in mm has 300 dots per inch.
Picture scaled(const Picture& picture, const FigureWidth& width, Format format);

}  // namespace forage::plot
