#include "core/model/system.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace forage::model {

GroupShape shape(const Topology& topology) {
    if (const auto* rect = std::get_if<RectTopology>(&topology)) {
        const long long cells = static_cast<long long>(rect->width) * rect->height;
        return {rect->width, rect->height, static_cast<int>(std::min(cells, max_extent))};
    }
    int min_x = std::numeric_limits<int>::max(), min_y = min_x, max_x = 0, max_y = 0;
    std::vector<std::pair<int, int>> places;  // each of them once, even when it is listed several times
    for (const auto& p : std::get<SparseTopology>(topology).points) {
        if (p.x < 1 || p.y < 1) continue;
        min_x = std::min(min_x, p.x), max_x = std::max(max_x, p.x);
        min_y = std::min(min_y, p.y), max_y = std::max(max_y, p.y);
        places.emplace_back(p.x, p.y);
    }
    if (places.empty()) return {};
    std::ranges::sort(places);
    const auto end = std::unique(places.begin(), places.end());
    return {max_x - min_x + 1, max_y - min_y + 1, static_cast<int>(end - places.begin())};
}

}  // namespace forage::model
