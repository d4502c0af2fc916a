// Where synapses stand when they are laid out by their source, so that those of silent sources are passed
// over and no synapse needs a cell number.
//
// Sources are taken line by line: rows of the grid, or columns, whichever keeps the synapse order at each
// target. Target lines that a line of sources reaches are live. They stand in a frame: cell a of line c at
// slot a * ring + c % ring, so that the targets of each source follow each other, and the next line of
// sources finds most of them where they are. When sources reach nearly all targets, these are one line.
#pragma once

#include <optional>

#include "core/engine/kernels/forms.h"

namespace forage::engine {

/// A group as lines of cells.
struct Lines {
    int cells, lines;
    int to_next_cell, to_next_line;

    Lines(GroupShape g, bool columns) {
        const bool grid = g.width * g.height == g.cells;
        const int width = grid ? g.width : g.cells, height = grid ? g.height : 1;
        cells = columns ? height : width, lines = columns ? width : height;
        to_next_cell = columns ? width : 1, to_next_line = columns ? 1 : width;
    }
    int line_of(int index) const { return to_next_line == 1 ? index % lines : index / to_next_line; }
    int cell_of(int index) const { return to_next_cell == 1 ? index % cells : index / to_next_cell; }
    int index(int cell, int line) const { return cell * to_next_cell + line * to_next_line; }
};

struct SourceLayout {
    /// The synapses of a source have a place for each slot of its stretch of the frame. Some slots are not
    /// live, or not connected to the source.
    struct Source {
        Index place;       ///< of its first synapse
        Index slot, size;  ///< of its targets in the frame
    };
    static constexpr int lanes = 4;  ///< stretches begin and end at multiples of it

    Lines source, target;
    bool dense = false;                  ///< every source has a place for every target
    int ring = 1;                        ///< lines for which the frame has room
    std::vector<int> left{}, entered{};  ///< by source line: the first live line, and the one after the last
    std::vector<Source> sources{};       ///< line by line
    Index places = 0;
    std::size_t live_slots = 0;  ///< of all sources' stretches

    std::size_t rank(int cell) const {  ///< of a source, line by line
        return static_cast<std::size_t>(source.line_of(cell) * source.cells + source.cell_of(cell));
    }
    Index slot(int cell, int line) const { return cell * ring + line % ring; }
    Index slots() const { return (target.cells * ring + lanes - 1) / lanes * lanes; }  ///< of the frame
    Index place(int pre, int post) const {
        const Source& from = sources[rank(pre)];
        return from.place + slot(target.cell_of(post), target.line_of(post)) - from.slot;
    }
};

/// The layout of a connection from every source to every target.
SourceLayout lay_out_all(GroupShape source, GroupShape target);
/// Finds the layout with the fewest places, at most `most` per synapse, in which every target sums its
/// synapses in synapse order. Returns nothing if there is none, also if two synapses connect the same cells.
std::optional<SourceLayout> lay_out_by_source(const ByTarget& synapses, GroupShape source, GroupShape target,
                                              double most);

}  // namespace forage::engine
