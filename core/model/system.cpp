#include "core/model/system.h"

#include <algorithm>
#include <limits>

namespace forage::model {

GroupShape shape(const Topology& topology) {
    if (const auto* rect = std::get_if<RectTopology>(&topology))
        return {rect->width, rect->height, rect->width * rect->height};
    int min_x = std::numeric_limits<int>::max(), min_y = min_x, max_x = 0, max_y = 0, cells = 0;
    for (const auto& p : std::get<SparseTopology>(topology).points) {
        if (p.x < 1 || p.y < 1) continue;
        min_x = std::min(min_x, p.x), max_x = std::max(max_x, p.x);
        min_y = std::min(min_y, p.y), max_y = std::max(max_y, p.y);
        ++cells;
    }
    if (cells == 0) return {};
    return {max_x - min_x + 1, max_y - min_y + 1, cells};
}

}  // namespace forage::model
