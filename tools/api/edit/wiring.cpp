#include "tools/api/edit/wiring.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/run/input_error.h"

namespace forage::editing {

using namespace model;

namespace {

constexpr std::size_t max_listed = 100'000;     ///< cells of both groups, which "nearest" lists one by one
constexpr std::size_t max_fitting = 1'000'000;  ///< pairs

/// The cells of a group, by their index.
std::vector<Point> cells_of(const Topology& topology) {
    std::vector<Point> out;
    if (const auto* sparse = std::get_if<SparseTopology>(&topology)) {
        out = sparse->points;
        std::ranges::sort(out, {}, [](const Point& p) { return std::pair(p.y, p.x); });
        return out;
    }
    const auto& rect = std::get<RectTopology>(topology);
    for (int y = 1; y <= rect.height; ++y)
        for (int x = 1; x <= rect.width; ++x) out.push_back({x, y, {}});
    return out;
}

/// The index of the cell nearest to the place in `topology` that a cell has in its own group.
std::size_t nearest(const Point& cell, const Topology& own, const Topology& topology,
                    const std::vector<Point>& cells) {
    const auto from = shape(own), to = shape(topology);
    const double x = (cell.x - 0.5) / from.width * to.width + 0.5;
    const double y = (cell.y - 0.5) / from.height * to.height + 0.5;
    if (std::holds_alternative<RectTopology>(topology)) {
        const auto whole = [](double v, int size) {
            return std::clamp(static_cast<int>(std::ceil(v - 0.5)), 1, size);
        };
        return std::size_t(whole(y, to.height) - 1) * std::size_t(to.width) +
               std::size_t(whole(x, to.width) - 1);
    }
    const auto distance = [&](const Point& p) { return std::hypot(p.x - x, p.y - y); };
    return std::size_t(std::ranges::min_element(cells, {}, distance) - cells.begin());
}

/// A tuple for each cell of the target, with its sources.
TuplesPattern tuples_of(const std::set<std::pair<std::size_t, std::size_t>>& pairs,
                        const std::vector<Point>& sources, const std::vector<Point>& targets) {
    TuplesPattern out;
    std::size_t last = targets.size();
    for (const auto& [t, s] : pairs) {
        if (t != std::exchange(last, t)) out.tuples.push_back({{}, {targets[t]}});
        out.tuples.back().sources.push_back(sources[s]);
    }
    return out;
}

Pattern listed(std::string_view wiring, const Topology& source, const Topology& target) {
    const auto count = std::size_t(shape(source).cells) + std::size_t(shape(target).cells);
    if (count > max_listed)
        throw InputError(fmt::format("the groups have {} cells, too many to be listed", count),
                         fmt::format("at most {}; choose 'all to all', or an arborization", max_listed));
    const auto sources = cells_of(source), targets = cells_of(target);
    std::set<std::pair<std::size_t, std::size_t>> pairs;  // target, source
    if (wiring == "one to one") {
        for (std::size_t i = 0; i < std::min(sources.size(), targets.size()); ++i) pairs.emplace(i, i);
    } else {
        for (std::size_t s = 0; s < sources.size(); ++s)
            pairs.emplace(nearest(sources[s], source, target, targets), s);
        for (std::size_t t = 0; t < targets.size(); ++t)
            pairs.emplace(t, nearest(targets[t], target, source, sources));
    }
    return tuples_of(pairs, sources, targets);
}

bool same_cells(const Topology& a, const Topology& b) {
    const auto *rect_a = std::get_if<RectTopology>(&a), *rect_b = std::get_if<RectTopology>(&b);
    if (rect_a && rect_b) return rect_a->width == rect_b->width && rect_a->height == rect_b->height;
    return a == b;
}

}  // namespace

const std::vector<std::string>& wirings() {
    static const std::vector<std::string> all = {"one to one", "all to all", "nearest"};
    return all;
}

Pattern wiring_pattern(std::string_view wiring, const Topology& source, const Topology& target) {
    const bool same = same_cells(source, target);
    if (wiring == "fitting") {
        const auto pairs = std::size_t(shape(source).cells) * std::size_t(shape(target).cells);
        return wiring_pattern(same                   ? "one to one"
                              : pairs <= max_fitting ? "all to all"
                                                     : "nearest",
                              source, target);
    }
    if (wiring == "all to all") return ForeachPattern{};
    if (std::ranges::find(wirings(), wiring) == wirings().end())
        throw InputError(fmt::format("'{}' is not a wiring", wiring),
                         fmt::format("one of {}, or fitting", fmt::join(wirings(), ", ")));
    return same ? MappedPattern{} : listed(wiring, source, target);
}

std::string wiring_of(const Connection& connection, const Topology& source, const Topology& target) {
    const bool tuples = std::holds_alternative<TuplesPattern>(connection.pattern);
    if (connection.arborization != Arborization{}) return "advanced";
    const auto listable = std::size_t(shape(source).cells) + std::size_t(shape(target).cells) <= max_listed;
    for (const auto& wiring : wirings())
        if ((!tuples || listable) && (tuples || wiring == "all to all" || same_cells(source, target)) &&
            wiring_pattern(wiring, source, target) == connection.pattern)
            return wiring;
    return tuples ? "chosen cells" : "advanced";
}

}  // namespace forage::editing
