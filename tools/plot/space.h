// Space plot: the values of a group's cells as a picture of the group.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/engine/plan/layout.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A rectangle of cells, with the coordinates of the group.
struct CellGrid {
    int x = 1, y = 1;  ///< upper left cell
    int width = 1, height = 1;
    bool numbered = false;  ///< whether the cells have no positions; x is their number then, from 1
    bool synapses = false;  ///< whether columns are source cells and rows are target cells
    CellNames names = {};   ///< what the cells of the group stand for
};

struct SpaceFrame {
    std::uint64_t cycle;
    std::vector<double> values;
    void checkpoint(Archive& archive) { archive(cycle, values); }
};

struct SpacePlot {
    std::string title, subtitle;
    std::string quantity;  ///< name of the values; shown beside the colour bar
    CellGrid grid;
    int blocks_across = 1, blocks_down = 1;  ///< lines divide the group into these blocks
    std::vector<SpaceFrame> frames;
    double seconds_per_cycle = 0;  ///< 0 if unknown
};

/// A sheet with all frames, which share a colour scale. There must be at least one frame.
Picture space_plot(const SpacePlot& plot);
/// The pictures of the frames, for render_animation(). They share a colour scale.
std::vector<Picture> space_animation(const SpacePlot& plot);

}  // namespace forage::plot
