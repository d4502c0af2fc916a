#include "bug_interface/sensing/grid.h"

namespace forage::bug {

void Grid::reserve(std::size_t items) {
    areas_.reserve(items), begin_.reserve((max_cells + 1) * (max_cells + 1) + 1), items_.reserve(4 * items);
}

void Grid::assign(const std::vector<Area>& areas, double cell) {
    areas_ = areas;
    if (areas.empty()) return;
    Area all = areas.front();
    for (const Area& a : areas)
        all = {std::min(all.min_x, a.min_x), std::min(all.min_y, a.min_y), std::max(all.max_x, a.max_x),
               std::max(all.max_y, a.max_y)};
    const double width = all.max_x - all.min_x, height = all.max_y - all.min_y;
    min_x_ = all.min_x, min_y_ = all.min_y, cell_ = std::max({cell, width / max_cells, height / max_cells});
    columns_ = 1 + static_cast<int>(width / cell_), rows_ = 1 + static_cast<int>(height / cell_);

    const auto for_each_cell = [&](const Area& a, auto&& visit) {
        for (int r = row(a.min_y); r <= row(a.max_y); ++r)
            for (int c = column(a.min_x); c <= column(a.max_x); ++c)
                visit(static_cast<std::size_t>(r * columns_ + c));
    };
    begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const Area& a : areas) for_each_cell(a, [&](std::size_t c) { ++begin_[c + 1]; });
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    items_.resize(begin_.back());
    // Filling moves each begin to that of the next cell; the shift below moves them back.
    for (std::uint32_t i = 0; i < areas.size(); ++i)
        for_each_cell(areas[i], [&](std::size_t c) { items_[begin_[c]++] = i; });
    std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
    begin_.front() = 0;
}

}  // namespace forage::bug
