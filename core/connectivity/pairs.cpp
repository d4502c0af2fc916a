#include "core/connectivity/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace forage::connectivity {
namespace {

using model::Point;

struct Rect {
    int x, y, width, height;
};

/// A region that reaches out of its group is moved to the left or upwards, and cut when it is larger.
void fit(int& start, int& extent, int first, int available) {
    extent = std::min(extent, available);
    if (start + extent > first + available) start = first + available - extent;
}

Rect extent(const model::Population& population, const Grid& grid) {
    if (const auto* region = std::get_if<model::Region>(&population)) {
        Rect r{region->x, region->y, region->width, region->height};
        fit(r.x, r.width, grid.left(), grid.width());
        fit(r.y, r.height, grid.top(), grid.height());
        return r;
    }
    return {grid.left(), grid.top(), grid.width(), grid.height()};
}

/// The cells of a population: row by row; of a list, in grid order and without duplicates.
std::vector<Place> cells(const model::Population& population, const Grid& grid) {
    std::vector<Place> out;
    if (const auto* list = std::get_if<model::List>(&population)) {
        std::set<std::pair<int, int>> places;
        for (const auto& p : list->points)
            if (grid.index(p.x, p.y) >= 0) places.emplace(p.y, p.x);
        for (const auto& [y, x] : places) out.push_back({double(x), double(y)});
        return out;
    }
    const Rect r = extent(population, grid);
    for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x)
            if (grid.index(x, y) >= 0) out.push_back({double(x), double(y)});
    return out;
}

void visit_mapped(const model::MappedPattern& pattern, const Grid& source, const Grid& target,
                  const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    for (const auto* population : {&pattern.source, &pattern.target})
        if (const auto* list = std::get_if<model::List>(population)) {
            diagnostics.error(list->at, "a PatternMapped cannot map a List of cells",
                              "use a Region or All, or a PatternForeach or PatternTuples for single cells");
            return;
        }
    const Rect s = extent(pattern.source, source), t = extent(pattern.target, target);
    const bool over_targets = static_cast<long long>(s.width) * s.height > static_cast<long long>(t.width) * t.height;
    const Rect& iterated = over_targets ? t : s;
    const Rect& projected = over_targets ? s : t;
    const double ratio_x = double(projected.width) / iterated.width, ratio_y = double(projected.height) / iterated.height;
    const double side_x = std::nearbyint(ratio_x), side_y = std::nearbyint(ratio_y);
    const auto link = [&](Place here, Place there) {
        if (over_targets) visit(there, here);
        else visit(here, there);
    };
    for (int row = 0; row < iterated.height; ++row)
        for (int column = 0; column < iterated.width; ++column) {
            const Place here{double(iterated.x + column), double(iterated.y + row)};
            const Place centre{(column + 0.5) * ratio_x + 0.5 + (projected.x - 1), (row + 0.5) * ratio_y + 0.5 + (projected.y - 1)};
            if (!pattern.all) {
                link(here, centre);
                continue;
            }
            const Span xs = cover(centre.x, side_x), ys = cover(centre.y, side_y);
            for (int x = xs.first; x <= xs.last; ++x)
                for (int y = ys.first; y <= ys.last; ++y) link(here, {double(x), double(y)});
        }
}

/// Points below 1 would give indices outside the group; points beyond its size are dropped like the original does.
bool usable(const Point& p, Diagnostics& diagnostics) {
    if (p.x >= 1 && p.y >= 1) return true;
    diagnostics.unknown(p.at, fmt::format("there is no cell at x = {}, y = {}", p.x, p.y), "cells count from 1");
    return false;
}

void visit_tuples(const model::TuplesPattern& pattern, const Grid& source, const Grid& target,
                  const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    for (const auto& tuple : pattern.tuples) {
        std::vector<Place> targets;
        for (const auto& t : tuple.targets)
            if (usable(t, diagnostics) && target.index(t.x, t.y) >= 0) targets.push_back({double(t.x), double(t.y)});
        for (const auto& s : tuple.sources)
            if (usable(s, diagnostics) && source.index(s.x, s.y) >= 0)
                for (const auto& t : targets) visit({double(s.x), double(s.y)}, t);
    }
}

}  // namespace

Span cover(double centre, double size) {
    return {static_cast<int>(std::ceil(centre - size / 2)), static_cast<int>(std::floor(centre + size / 2))};
}

void for_each_pair(const model::Pattern& pattern, const Grid& source, const Grid& target,
                   const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
        visit_mapped(*mapped, source, target, visit, diagnostics);
    } else if (const auto* foreach = std::get_if<model::ForeachPattern>(&pattern)) {
        const auto targets = cells(foreach->target, target);
        for (const auto& s : cells(foreach->source, source))
            for (const auto& t : targets) visit(s, t);
    } else {
        visit_tuples(std::get<model::TuplesPattern>(pattern), source, target, visit, diagnostics);
    }
}

}  // namespace forage::connectivity
