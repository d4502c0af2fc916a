// Several pictures as the panels of one figure.
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

/// The places of a figure's panels, and its width.
struct FigureLayout {
    int rows = 1, columns = 1;
    std::optional<double> width_mm = {};  ///< empty: the panels keep their sizes
};

/// Reads "ROWSxCOLUMNS", such as "2x3"; `width_mm` is 0 when none is given. Reports mistakes. Empty when
/// there was one.
std::optional<FigureLayout> parse_layout(std::string_view text, double width_mm, Diagnostics& diagnostics);

/// The panels row by row, each with a letter at its upper left: a, b, c, ... A column is as wide as its
/// widest panel, and a row as high as its highest one. There are no more panels than places, and at most 26.
Picture figure(std::vector<Picture> panels, const FigureLayout& layout);

}  // namespace forage::plot
