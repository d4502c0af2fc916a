// Space plot: the numbers of a group's cells as a picture of the group.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A rectangle of cells, numbered as in the group.
struct CellGrid {
    int x = 1, y = 1;  ///< its upper left cell
    int width = 1, height = 1;
    bool numbered = false;  ///< the cells have no places: x is their number, from 1
};

struct SpaceFrame {
    std::uint64_t cycle;
    std::vector<double> values;
    void checkpoint(Archive& archive) { archive(cycle, values); }
};

struct SpacePlot {
    std::string title, subtitle;
    std::string quantity;  ///< what the numbers are, beside the colour bar
    CellGrid grid;
    int blocks_across = 1, blocks_down = 1;  ///< lines divide the group into so many blocks
    std::vector<SpaceFrame> frames;
};

/// All frames on one sheet, with one scale of colours. There must be a frame.
Picture space_plot(const SpacePlot& plot);
/// A picture per frame, with one scale of colours: for render_animation().
std::vector<Picture> space_animation(const SpacePlot& plot);

}  // namespace forage::plot
