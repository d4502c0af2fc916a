// Where the highest cell of a group is.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace forage::goal {

using Eigen::Index;

struct Place {
    Index row = 0, column = 0;
    friend bool operator==(const Place&, const Place&) = default;
};

/// The first of the cells that are highest when compared in single precision.
inline Index highest_cell(const Eigen::Ref<const Eigen::ArrayXd>& cells) {
    Index best = 0;
    for (Index i = 1; i < cells.size(); ++i)
        if (static_cast<float>(cells[i]) > static_cast<float>(cells[best])) best = i;
    return best;
}

/// Row and column of the highest cell of a group of `width` cells per row; none when no cell is above 0 or
/// all cells are equal.
inline std::optional<Place> place_of(const Eigen::Ref<const Eigen::ArrayXd>& cells, Index width) {
    const Index best = highest_cell(cells);
    const auto top = static_cast<float>(cells[best]);
    if (!(top > 0) || (cells.cast<float>() == top).all()) return std::nullopt;
    return Place{best / width, best % width};
}

}  // namespace forage::goal
