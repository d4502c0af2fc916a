#include "core/connectivity/pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace forage::connectivity {
namespace {

using model::Point;

struct Rect {
    int x, y, width, height;
};

/// Moves a region that extends beyond its group to the left or upwards, and cuts it when it is larger than
/// the group.
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

/// Warns about what the original does silently, although it is probably not meant.
void warn_of_fit(const model::Population& population, const Grid& grid, Diagnostics& diagnostics) {
    const auto* region = std::get_if<model::Region>(&population);
    if (!region) return;
    const Rect r = extent(population, grid);
    if (r.x != region->x || r.y != region->y || r.width != region->width || r.height != region->height)
        diagnostics.warning(region->at,
                            fmt::format("the region reaches out of the group, which has {} x {} cells",
                                        grid.width(), grid.height()),
                            fmt::format("it acts as xstart=\"{}\" ystart=\"{}\" width=\"{}\" height=\"{}\"",
                                        r.x, r.y, r.width, r.height));
}

/// Whether there is a cell at `p`. A coordinate below 1 is an error, as the original computes an index
/// outside the group. Other positions without a cell are skipped, as in the original.
bool usable(const Point& p, const Grid& grid, Diagnostics& diagnostics) {
    if (grid.index(p.x, p.y) >= 0) return true;
    const std::string message = fmt::format("there is no cell at x = {}, y = {}", p.x, p.y);
    if (p.x < 1 || p.y < 1)
        diagnostics.unknown(p.at, message, "cells count from 1");
    else
        diagnostics.warning(p.at, message + ": the point is ignored",
                            fmt::format("the group has {} x {} cells", grid.width(), grid.height()));
    return false;
}

/// The cells of a population, row by row; those of a list in grid order and without duplicates.
std::vector<Place> cells(const model::Population& population, const Grid& grid, Diagnostics& diagnostics) {
    std::vector<Place> out;
    if (const auto* list = std::get_if<model::List>(&population)) {
        std::set<std::pair<int, int>> places;
        for (const auto& p : list->points)
            if (usable(p, grid, diagnostics)) places.emplace(p.y, p.x);
        for (const auto& [y, x] : places) out.push_back({double(x), double(y)});
        return out;
    }
    warn_of_fit(population, grid, diagnostics);
    const Rect r = extent(population, grid);
    for (int y = r.y; y < r.y + r.height; ++y)
        for (int x = r.x; x < r.x + r.width; ++x)
            if (grid.index(x, y) >= 0) out.push_back({double(x), double(y)});
    return out;
}

/// The cells of the smaller population, and the larger population that it is projected onto.
struct Projection {
    Rect iterated, projected;
    bool over_targets;
    double ratio_x, ratio_y;
};

Projection project(const model::MappedPattern& pattern, const Grid& source, const Grid& target) {
    const Rect s = extent(pattern.source, source), t = extent(pattern.target, target);
    const bool over_targets =
        static_cast<long long>(s.width) * s.height > static_cast<long long>(t.width) * t.height;
    const Rect &iterated = over_targets ? t : s, &projected = over_targets ? s : t;
    return {iterated, projected, over_targets, double(projected.width) / iterated.width,
            double(projected.height) / iterated.height};
}

void visit_mapped(const model::MappedPattern& pattern, const Grid& source, const Grid& target,
                  const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    for (const auto* population : {&pattern.source, &pattern.target})
        if (const auto* list = std::get_if<model::List>(population)) {
            diagnostics.error(list->at, "a PatternMapped cannot map a List of cells",
                              "use a Region or All, or a PatternForeach or PatternTuples for single cells");
            return;
        }
    warn_of_fit(pattern.source, source, diagnostics);
    warn_of_fit(pattern.target, target, diagnostics);
    const Projection p = project(pattern, source, target);
    const Rect &iterated = p.iterated, &projected = p.projected;
    const double side_x = std::nearbyint(p.ratio_x), side_y = std::nearbyint(p.ratio_y);
    const auto link = [&](Place here, Place there) {
        if (p.over_targets)
            visit(there, here);
        else
            visit(here, there);
    };
    for (int row = 0; row < iterated.height; ++row)
        for (int column = 0; column < iterated.width; ++column) {
            const Place here{double(iterated.x + column), double(iterated.y + row)};
            const Place centre{(column + 0.5) * p.ratio_x + 0.5 + (projected.x - 1),
                               (row + 0.5) * p.ratio_y + 0.5 + (projected.y - 1)};
            if (!pattern.all) {
                link(here, centre);
                continue;
            }
            const Span xs = cover(centre.x, side_x), ys = cover(centre.y, side_y);
            for (int x = xs.first; x <= xs.last; ++x)
                for (int y = ys.first; y <= ys.last; ++y) link(here, {double(x), double(y)});
        }
}

void visit_tuples(const model::TuplesPattern& pattern, const Grid& source, const Grid& target,
                  const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    for (const auto& tuple : pattern.tuples) {
        std::vector<Place> targets;
        for (const auto& t : tuple.targets)
            if (usable(t, target, diagnostics)) targets.push_back({double(t.x), double(t.y)});
        for (const auto& s : tuple.sources)
            if (usable(s, source, diagnostics))
                for (const auto& t : targets) visit({double(s.x), double(s.y)}, t);
    }
}

}  // namespace

Span cover(double centre, double size) {
    return {static_cast<int>(std::ceil(centre - size / 2)), static_cast<int>(std::floor(centre + size / 2))};
}

std::optional<std::vector<int>> indices(const model::Population& population, const Grid& grid) {
    Diagnostics found;
    std::vector<int> out;
    for (const auto& [x, y] : cells(population, grid, found))
        out.push_back(grid.index(static_cast<int>(x), static_cast<int>(y)));
    if (!found.all().empty()) return {};
    return out;
}

double max_pairs(const model::Pattern& pattern, const Grid& source, const Grid& target) {
    const auto size = [](const model::Population& population, const Grid& grid) {
        if (const auto* list = std::get_if<model::List>(&population))
            return static_cast<double>(list->points.size());
        const Rect r = extent(population, grid);
        return static_cast<double>(r.width) * r.height;
    };
    if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
        const Projection p = project(*mapped, source, target);
        const double cells = static_cast<double>(p.iterated.width) * p.iterated.height;
        return mapped->all ? cells * (std::nearbyint(p.ratio_x) + 1) * (std::nearbyint(p.ratio_y) + 1)
                           : cells;
    }
    if (const auto* foreach = std::get_if<model::ForeachPattern>(&pattern))
        return size(foreach->source, source) * size(foreach->target, target);
    double pairs = 0;
    const auto* tuples = std::get_if<model::TuplesPattern>(&pattern);  // weights pair no cells themselves
    for (const auto& tuple : tuples ? tuples->tuples : std::vector<model::TuplesPattern::Tuple>())
        pairs += static_cast<double>(tuple.sources.size()) * static_cast<double>(tuple.targets.size());
    return pairs;
}

void for_each_pair(const model::Pattern& pattern, const Grid& source, const Grid& target,
                   const std::function<void(Place, Place)>& visit, Diagnostics& diagnostics) {
    if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
        visit_mapped(*mapped, source, target, visit, diagnostics);
    } else if (const auto* foreach = std::get_if<model::ForeachPattern>(&pattern)) {
        const auto targets = cells(foreach->target, target, diagnostics);
        for (const auto& s : cells(foreach->source, source, diagnostics))
            for (const auto& t : targets) visit(s, t);
    } else if (const auto* tuples = std::get_if<model::TuplesPattern>(&pattern)) {
        visit_tuples(*tuples, source, target, visit, diagnostics);
    }
}

}  // namespace forage::connectivity
