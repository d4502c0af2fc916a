#include "core/engine/kernels/source_layout.h"

#include <limits>

namespace forage::engine {
namespace {

struct Range {
    int first = std::numeric_limits<int>::max(), last = -1;
    void add(const Range& r) { first = std::min(first, r.first), last = std::max(last, r.last); }
};
/// Columns and rows of the grid in which a source has targets.
struct Reach {
    Range x, y;
};

GroupShape one_line(GroupShape g) { return {g.cells, 1, g.cells}; }

std::vector<Reach> reach_of(const ByTarget& s, int source_cells, GroupShape target) {
    std::vector<Reach> out(source_cells);
    const Lines rows(target, false);
    for (int t = 0; t < target.cells; ++t) {
        const int x = rows.cell_of(t), y = rows.line_of(t);
        for (int i = s.start[t]; i < s.start[t + 1]; ++i)
            out[s.pre[i]].x.add({x, x}), out[s.pre[i]].y.add({y, y});
    }
    return out;
}

/// Whether the synapses of each target are in the order of these lines, and all from different sources.
bool in_order(const ByTarget& s, const Lines& source) {
    const auto rank = [&](int cell) { return source.line_of(cell) * source.cells + source.cell_of(cell); };
    for (std::size_t t = 0; t < s.targets(); ++t)
        for (int i = s.start[t] + 1; i < s.start[t + 1]; ++i)
            if (rank(s.pre[i]) <= rank(s.pre[i - 1])) return false;
    return true;
}

constexpr int rounded_up(int n) {
    return (n + SourceLayout::lanes - 1) / SourceLayout::lanes * SourceLayout::lanes;
}

/// A place for every target.
SourceLayout dense_layout(const Lines& source, GroupShape target) {
    SourceLayout out{source, Lines(one_line(target), false)};
    out.dense = true;
    out.left.assign(source.lines, 0), out.entered.assign(source.lines, 1);
    const Index size = rounded_up(target.cells), sources = Index{source.lines} * source.cells;
    for (; out.places < size * sources; out.places += size) out.sources.push_back({out.places, 0, size});
    out.live_slots = static_cast<std::size_t>(sources * target.cells);
    return out;
}

/// Places for the target lines and cells that a source reaches.
SourceLayout local_layout(const Lines& source, const Lines& target, bool columns,
                          const std::vector<Reach>& reach) {
    SourceLayout out{source, target};
    std::vector<Range> lines(source.lines);
    for (int line = 0; line < source.lines; ++line)
        for (int cell = 0; cell < source.cells; ++cell) {
            const Reach& r = reach[source.index(cell, line)];
            lines[line].add(columns ? r.x : r.y);
        }
    for (std::size_t n = 1; n < lines.size(); ++n) {  // lines come and go in order
        lines[n].last = std::max(lines[n].last, lines[n - 1].last);
        auto &later = lines[lines.size() - n], &earlier = lines[lines.size() - n - 1];
        earlier.first = std::min(earlier.first, later.first);
    }
    for (const Range& r : lines) {
        out.entered.push_back(r.last + 1), out.left.push_back(std::min(r.first, r.last + 1));
        out.ring = std::max(out.ring, out.entered.back() - out.left.back());
    }
    out.ring = rounded_up(out.ring);
    for (int line = 0; line < source.lines; ++line)
        for (int cell = 0; cell < source.cells; ++cell) {
            const Reach& r = reach[source.index(cell, line)];
            const Range& cells = columns ? r.y : r.x;
            const Index first = cells.last < 0 ? 0 : cells.first, count = cells.last + 1 - first;
            out.sources.push_back({out.places, first * out.ring, count * out.ring});
            out.places += count * out.ring;
            out.live_slots += count * (out.entered[line] - out.left[line]);
        }
    return out;
}

}  // namespace

SourceLayout lay_out_all(GroupShape source, GroupShape target) {
    return dense_layout(Lines(one_line(source), false), target);
}

std::optional<SourceLayout> lay_out_by_source(const ByTarget& s, GroupShape source, GroupShape target,
                                              double most) {
    const auto reach = reach_of(s, source.cells, target);
    std::optional<SourceLayout> best;
    const auto consider = [&](SourceLayout layout) {
        const auto enough =
            best ? static_cast<double>(best->places) : most * static_cast<double>(s.pre.size()) + 1;
        if (static_cast<double>(layout.places) < enough) best = std::move(layout);
    };
    for (const bool columns : {false, true}) {
        const Lines lines(source, columns);
        if (!in_order(s, lines)) continue;
        consider(dense_layout(columns ? lines : Lines(one_line(source), false), target));
        for (const bool target_columns : {columns, !columns})
            consider(local_layout(lines, Lines(target, target_columns), target_columns, reach));
    }
    return best;
}

}  // namespace forage::engine
