// The pictures that users ask for.
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
///     movie:Process/Group@0..500/10      the group at these cycles as an animation
///     connection:NAME                    the synapses between the cells of two groups
///     diagram, diagram:Process           the diagram of the system or of one process
///     trajectory                         the robot's paths
///
/// A source is 'Process/Group:state(x1..x2,y1..y2)'. Cycles are N, A..B or A..B/STEP. ';blocks=9x1' at the
/// end of a space plot draws lines between that many blocks.
struct PlotSpec {
    enum class Kind { time, space, movie, connection, diagram, trajectory };
    struct Cycles {
        std::uint64_t first, last, step;
        bool contains(std::uint64_t c) const { return c >= first && c <= last && (c - first) % step == 0; }
    };
    Kind kind = Kind::time;
    std::string text;  ///< the whole text
    std::string what;  ///< the source, connection or process; may be empty for diagram and trajectory
    std::vector<Cycles> cycles;
    int blocks_across = 1, blocks_down = 1;

    bool of_cells() const { return kind == Kind::time || kind == Kind::space || kind == Kind::movie; }
    bool wants(std::uint64_t cycle) const;
    /// The name of the picture's file. Animations are always PNG files.
    std::string file(Format format) const;
};

/// Reads a picture's text. Reports mistakes; `option` says where the text is from. Empty when there was an
/// error.
std::optional<PlotSpec> parse_plot(std::string_view text, std::string_view option, Diagnostics& diagnostics,
                                   Location at = {});

}  // namespace forage::plot
