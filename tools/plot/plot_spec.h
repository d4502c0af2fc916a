// What a person wants to see.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// One picture, as written on the command line:
///
///     time:Process/Group                 cells over time; 'time:mean:Process/Group' for their mean
///     space:Process/Group@100,200        the group at these cycles; without '@' at the last one
///     movie:Process/Group@0..500/10      the same as a moving picture
///     connection:NAME                    which cells reach which
///     diagram, diagram:Process           the system as the file lays it out, or one process
///     trajectory                         the robot's paths
///
/// A column is 'Process/Group:state(x1..x2,y1..y2)'; cycles are N, A..B or A..B/STEP; ';blocks=9x1' at the
/// end draws lines between so many blocks of a space plot.
struct PlotSpec {
    enum class Kind { time, space, movie, connection, diagram, trajectory };
    struct Cycles {
        std::uint64_t first, last, step;
        bool contains(std::uint64_t c) const { return c >= first && c <= last && (c - first) % step == 0; }
    };
    Kind kind = Kind::time;
    std::string text;  ///< all of it
    std::string what;  ///< column, connection or process; may be empty for the last two kinds
    std::vector<Cycles> cycles;
    int blocks_across = 1, blocks_down = 1;

    bool of_cells() const { return kind == Kind::time || kind == Kind::space || kind == Kind::movie; }
    bool wants(std::uint64_t cycle) const;
    /// The name of its file; moving pictures are PNG files always.
    std::string file(Format format) const;
};

/// Reports what is not one; `option` says where the text stands.
std::optional<PlotSpec> parse_plot(std::string_view text, std::string_view option, Diagnostics& diagnostics,
                                   Location at = {});

}  // namespace forage::plot
