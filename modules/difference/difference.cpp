#include "modules/difference/difference.h"

namespace forage::goal {

void show_difference(const std::optional<GridPosition>& location, const std::optional<GridPosition>& goal,
                     Index width, Index height, Eigen::Ref<Eigen::ArrayXd> out) {
    out.setZero();
    if (!location || !goal) return;
    const Index row = goal->row - location->row + height - 1,
                column = goal->column - location->column + width - 1;
    out[row * (2 * width - 1) + column] = 1;
}

}  // namespace forage::goal
