// The pictures that users ask for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/expression.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A picture, as written on the command line (docs/reference/expressions.md).
struct PlotSpec : expression::Plot {
    std::string text;  ///< the whole text
    std::string part;  ///< the part of the results that it shows; empty for all

    /// The source of the rows of numbers. A connection at given cycles is its weights.
    std::string source() const { return of_connection() ? "\"" + what + "\":weight" : what; }
    /// The sources of a plot over time, one after each "), "; else the only one.
    std::vector<std::string> sources() const;
    bool wants(std::uint64_t cycle) const;
    /// The wanted cycles that are greater than `end`: "5..7, 9000"; empty when there are none.
    std::string after(std::uint64_t end) const;
    /// The name of the picture's file. Animations are always PNG files.
    std::string file(Format format) const;
};

/// Reads a picture's text. Reports mistakes; `option` says where the text is from. Empty when there was an
/// error.
std::optional<PlotSpec> parse_plot(std::string_view text, std::string_view option, Diagnostics& diagnostics,
                                   Location at = {});

}  // namespace forage::plot
