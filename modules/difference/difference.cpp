#include "modules/difference/difference.h"

#include <fmt/format.h>

namespace forage::goal {

void show_difference(const std::optional<GridPosition>& location, const std::optional<GridPosition>& goal,
                     Index width, Index height, Eigen::Ref<Eigen::ArrayXd> out) {
    out.setZero();
    if (!location || !goal) return;
    const Index row = goal->row - location->row + height - 1,
                column = goal->column - location->column + width - 1;
    out[row * (2 * width - 1) + column] = 1;
}

void DifferenceModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    const auto require = [&](const ModulePorts::Group& group, int width, int height, const char* why) {
        if (group.shape == GroupShape{width, height, width * height}) return;
        diagnostics.error(
            at_port(group.port),
            fmt::format("'{}' needs {} x {} cells, {}; '{}' has {} in {} x {}", group.port, width, height,
                        why, group.path, group.shape.cells, group.shape.width, group.shape.height),
            fmt::format("make the group {} x {}", width, height));
    };
    const auto& location = ports.inputs[0].shape;
    require(ports.inputs[0], location.width, location.height, "a full rectangle");
    require(ports.inputs[1], location.width, location.height, "the size of '_location'");
    require(ports.outputs[0], 2 * location.width - 1, 2 * location.height - 1,
            "twice the width and height of '_location' less one");
}

}  // namespace forage::goal
