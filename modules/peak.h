// The position of the most active cell of a group.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace forage::goal {

using Eigen::Index;

/// A cell of a rectangular group.
struct GridPosition {
    Index row = 0, column = 0;
    friend bool operator==(const GridPosition&, const GridPosition&) = default;
};

/// The index of the most active cell; the first of several that are equal in single precision.
inline Index highest_cell(const Eigen::Ref<const Eigen::ArrayXd>& cells) {
    Index best = 0;
    for (Index i = 1; i < cells.size(); ++i)
        if (static_cast<float>(cells[i]) > static_cast<float>(cells[best])) best = i;
    return best;
}

/// The position of the most active cell of a group with `width` cells per row. Empty when no cell is above 0,
/// and when all cells are equal in single precision.
inline std::optional<GridPosition> peak_position(const Eigen::Ref<const Eigen::ArrayXd>& cells, Index width) {
    const Index best = highest_cell(cells);
    const auto top = static_cast<float>(cells[best]);
    if (!(top > 0) || (cells.cast<float>() == top).all()) return std::nullopt;
    return GridPosition{best / width, best % width};
}

}  // namespace forage::goal
