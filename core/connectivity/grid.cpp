#include "core/connectivity/grid.h"

#include <limits>

namespace forage::connectivity {

Grid::Grid(const model::Topology& topology) {
    if (const auto* rect = std::get_if<model::RectTopology>(&topology)) {
        width_ = rect->width, height_ = rect->height, cells_ = width_ * height_;
        wrap_x_ = rect->wrap_x, wrap_y_ = rect->wrap_y;
        return;
    }
    const auto& points = std::get<model::SparseTopology>(topology).points;
    const GroupShape extent = model::shape(topology);
    width_ = extent.width, height_ = extent.height;
    left_ = top_ = std::numeric_limits<int>::max();
    for (const auto& p : points)
        if (p.x >= 1 && p.y >= 1) left_ = std::min(left_, p.x), top_ = std::min(top_, p.y);
    rank_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
    for (const auto& p : points)
        if (p.x >= 1 && p.y >= 1) rank_[static_cast<std::size_t>((p.y - top_) * width_ + (p.x - left_))] = 0;
    for (int& r : rank_)
        if (r == 0) r = cells_++;
}

}  // namespace forage::connectivity
