// Where the synapses of a list stand in memory, so that sums read it from the first byte to the last.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/huge_pages.h"
#include "core/engine/kernels/by_target.h"

namespace forage::engine {

/// Targets in panels and sources in blocks: the activity of a block stays in the nearest cache, the sums of a
/// panel in the second. The synapses from a block to a panel are a tile; panels follow each other, and in
/// each its tiles. Within a tile targets stand in slices of eight side by side, those with most synapses
/// first ("sliced ELLPACK"; Kreutzer et al., "A unified sparse matrix data format...", SIAM J. Sci. Comput.
/// 36, 2014): synapse k of lane l of a slice is its entry 8 k + l, and lanes that have no such synapse are
/// padding.
struct Slices {
    static constexpr std::size_t lanes = 8, half = lanes / 2, most_panel_cells = 8192;

    /// Slices of a tile that follow each other and are of the same length.
    struct Run {
        std::uint32_t block, slices, length;
    };
    /// The first of what belongs to a panel.
    struct Panel {
        std::size_t run, slice, entry;
    };

    std::size_t block_cells, panel_cells;  ///< of all but the last
    std::vector<Panel> panels;             ///< and one for the end
    std::vector<Run> runs;
    HugeVector<std::uint16_t> targets;  ///< of lane l of slice i: targets[8 i + l], in its panel;
                                        ///< panel_cells for none

    std::size_t entries() const { return panels.back().entry; }
};

/// Null when a target returns to a block after another one: its synapses would be summed in another order.
std::optional<Slices> arrange(const ByTarget& synapses, std::size_t source_cells, std::size_t block_cells);

}  // namespace forage::engine
