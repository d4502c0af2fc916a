#include "tools/plot/layers.h"

#include <algorithm>
#include <functional>

namespace forage::plot {
namespace {

using Arrows = std::vector<std::pair<std::size_t, std::size_t>>;

constexpr int widest_row = 6;
constexpr int sweeps = 6;  ///< rounds in which the rows are sorted

/// An order of the boxes in which arrows lead forward, but for those that close a circle.
std::vector<std::size_t> ordered(std::size_t boxes, const Arrows& arrows) {
    std::vector<std::size_t> out;
    std::vector<bool> visited(boxes), receives(boxes);
    const std::function<void(std::size_t)> visit = [&](std::size_t box) {
        if (visited[box]) return;
        visited[box] = true;
        for (const auto& [from, to] : arrows)
            if (from == box) visit(to);
        out.push_back(box);
    };
    for (const auto& [from, to] : arrows)
        if (from != to) receives[to] = true;
    for (const bool inner : {false, true})  // sources first, so that only circles are cut
        for (std::size_t box = 0; box < boxes; ++box)
            if (receives[box] == inner) visit(box);
    std::ranges::reverse(out);
    return out;
}

/// The row of each box: one more than the last of those before it; large rows are divided.
std::vector<int> rows_of(std::size_t boxes, const Arrows& arrows) {
    const auto order = ordered(boxes, arrows);
    std::vector<std::size_t> position(boxes);
    for (std::size_t i = 0; i < boxes; ++i) position[order[i]] = i;
    std::vector<int> depth(boxes), row(boxes);
    for (const std::size_t box : order)
        for (const auto& [from, to] : arrows)
            if (from == box && position[to] > position[from])
                depth[to] = std::max(depth[to], depth[from] + 1);
    int first = 0;  // row of this depth
    for (int d = 0; d < static_cast<int>(boxes); ++d) {
        int count = 0;
        for (std::size_t box = 0; box < boxes; ++box)
            if (depth[box] == d) row[box] = first + count++ / widest_row;
        first += (count + widest_row - 1) / widest_row;
    }
    return row;
}

}  // namespace

Layers layered(std::size_t boxes, const Arrows& arrows) {
    // An item is a box, or a place that an arrow passes between its ends.
    std::vector<int> row = rows_of(boxes, arrows);
    std::vector<std::vector<std::size_t>> passes(arrows.size());
    Arrows links;  // between neighbouring rows
    for (std::size_t a = 0; a < arrows.size(); ++a) {
        const auto [from, to] = arrows[a];
        const int step = row[to] > row[from] ? 1 : -1;
        std::size_t last = from;
        for (int r = row[from] + step; (row[to] - r) * step > 0; r += step) {
            passes[a].push_back(row.size());
            links.emplace_back(last, row.size());
            last = row.size();
            row.push_back(r);
        }
        links.emplace_back(last, to);
    }
    std::vector<std::vector<std::size_t>> rows(1);
    for (std::size_t i = 0; i < row.size(); ++i) {
        rows.resize(std::max(rows.size(), static_cast<std::size_t>(row[i]) + 1));
        rows[static_cast<std::size_t>(row[i])].push_back(i);
    }
    std::vector<double> column(row.size());
    const auto spread = [&](const std::vector<std::size_t>& items) {
        for (std::size_t i = 0; i < items.size(); ++i)
            column[items[i]] = static_cast<double>(i) - static_cast<double>(items.size() - 1) / 2;
    };
    for (const auto& items : rows) spread(items);
    // Each row is sorted by the mean column of the neighbours of its items, so that few arrows cross.
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t r = 0; r < rows.size(); ++r) {
            auto& items = rows[sweep % 2 == 0 ? r : rows.size() - 1 - r];
            const int beside = sweep % 2 == 0 ? -1 : 1;
            std::vector<std::pair<double, std::size_t>> wanted;
            for (const std::size_t i : items) {
                double sum = 0, count = 0;
                for (const auto& [a, b] : links)
                    for (const auto& [self, other] : {std::pair(a, b), std::pair(b, a)})
                        if (self == i && row[other] == row[i] + beside) sum += column[other], ++count;
                wanted.emplace_back(count > 0 ? sum / count : column[i], i);
            }
            std::ranges::stable_sort(wanted, [](const auto& a, const auto& b) { return a.first < b.first; });
            for (std::size_t i = 0; i < items.size(); ++i) items[i] = wanted[i].second;
            spread(items);
        }
    Layers out;
    const auto place = [&](std::size_t i) { return Layers::Place{column[i], row[i]}; };
    for (std::size_t i = 0; i < boxes; ++i) out.boxes.push_back(place(i));
    for (const auto& items : passes) {
        auto& bends = out.bends.emplace_back();
        for (const std::size_t i : items) bends.push_back(place(i));
    }
    return out;
}

}  // namespace forage::plot
