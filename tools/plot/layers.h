// Layers: places for the boxes of a diagram that its file does not place.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace forage::plot {

struct Layers {
    struct Place {
        double column;  ///< in steps from the middle of the row
        int row;        ///< from 0, downwards
    };
    std::vector<Place> boxes;
    std::vector<std::vector<Place>> bends;  ///< of each arrow: the places between boxes that it passes
};

/// Puts each box below all boxes from which an arrow leads to it (the longest path from a source). Arrows
/// that close a circle lead upwards. A row has at most six boxes. `arrows` are pairs of boxes.
Layers layered(std::size_t boxes, const std::vector<std::pair<std::size_t, std::size_t>>& arrows);

}  // namespace forage::plot
