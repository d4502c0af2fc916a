#include "core/connectivity/arbor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace forage::connectivity {
namespace {

/// The rows that an ellipse covers at column x. `xs` are the columns that it covers.
Span ellipse_rows(Place c, Span xs, int x, int width, int height) {
    const double a = width / 2.0, b = height / 2.0;
    const double offset = x - (xs.first + xs.last) / 2.0;
    const double squared = b * b - offset * offset * (b * b) / (a * a);
    // `squared` is NaN when the ellipse has no width; it covers nothing then.
    return squared >= 0 ? cover(c.y, 2 * std::sqrt(squared)) : Span{1, 0};
}

Span overlap(Span a, Span b) { return {std::max(a.first, b.first), std::min(a.last, b.last)}; }

double length(Span s) { return s.last < s.first ? 0 : s.last - s.first + 1.0; }

bool inside(Span s, int k) { return s.first <= k && k <= s.last; }

/// The coordinates of points that can be a cell, when a cylinder wraps around once.
Span reach(int first, int size, bool wraps) {
    return wraps ? Span{first - size, first + 2 * size - 1} : Span{first, first + size - 1};
}

int wrapped(int k, int first, int size, bool wraps) {
    if (wraps && k < first)
        k += size;
    else if (wraps && k >= first + size)
        k -= size;
    return k;
}

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace

Arbor::Arbor(const model::Arborization& arborization, const Grid& grid, RandomStream random)
    : arborization_(arborization),
      grid_(grid),
      random_(random),
      reach_x_(reach(grid.left(), grid.width(), grid.wraps_x())),
      reach_y_(reach(grid.top(), grid.height(), grid.wraps_y())) {
    if (std::holds_alternative<model::RandomArbor>(arborization.shape)) {
        places_.resize(static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height()));
        std::iota(places_.begin(), places_.end(), 0);
    }
}

// Points out of reach are not cells. They are skipped early, so that a large arborization on a small group is
// cheap.
void Arbor::rectangle(Place c, int width, int height, const PointVisitor& visit) const {
    const Span xs = overlap(cover(c.x, width), reach_x_), ys = overlap(cover(c.y, height), reach_y_);
    for (int x = xs.first; x <= xs.last; ++x)
        for (int y = ys.first; y <= ys.last; ++y) visit(x, y);
}

void Arbor::ellipse(Place c, int width, int height, const PointVisitor& visit) const {
    const Span covered = cover(c.x, width), xs = overlap(covered, reach_x_);
    for (int x = xs.first; x <= xs.last; ++x) {
        const Span ys = overlap(ellipse_rows(c, covered, x, width, height), reach_y_);
        for (int y = ys.first; y <= ys.last; ++y) visit(x, y);
    }
}

double Arbor::max_points(bool whole) const {
    const auto covered = [whole](int size) { return size + (whole && size % 2 != 0 ? 0.0 : 1.0); };
    const auto box = [&](int width, int height) {
        return std::min(covered(width), length(reach_x_)) * std::min(covered(height), length(reach_y_));
    };
    const double all = static_cast<double>(grid_.width()) * grid_.height();
    return std::visit(
        Overloaded{
            [&](const model::RectArbor& a) { return box(a.width, a.height); },
            [&](const model::EllipseArbor& a) { return box(a.width, a.height); },
            [&](const model::RectWindowArbor& a) { return box(a.outer_width, a.outer_height); },
            [&](const model::EllipseWindowArbor& a) { return box(a.outer_width, a.outer_height); },
            [&](const model::AllArbor&) { return all; },
            [&](const model::RandomArbor& a) { return std::min<double>(a.count, all); },
        },
        arborization_.shape);
}

void Arbor::points(Place c, const PointVisitor& visit) {
    std::visit(
        Overloaded{
            [&](const model::RectArbor& a) { rectangle(c, a.width, a.height, visit); },
            [&](const model::EllipseArbor& a) { ellipse(c, a.width, a.height, visit); },
            [&](const model::RectWindowArbor& a) {
                const Span xs = cover(c.x, a.inner_width), ys = cover(c.y, a.inner_height);
                rectangle(c, a.outer_width, a.outer_height, [&](int x, int y) {
                    if (!(inside(xs, x) && inside(ys, y))) visit(x, y);
                });
            },
            [&](const model::EllipseWindowArbor& a) {
                const Span xs = cover(c.x, a.inner_width);
                ellipse(c, a.outer_width, a.outer_height, [&](int x, int y) {
                    if (!(inside(xs, x) && inside(ellipse_rows(c, xs, x, a.inner_width, a.inner_height), y)))
                        visit(x, y);
                });
            },
            [&](const model::AllArbor&) {
                for (int y = grid_.top(); y < grid_.top() + grid_.height(); ++y)
                    for (int x = grid_.left(); x < grid_.left() + grid_.width(); ++x) visit(x, y);
            },
            [&](const model::RandomArbor& a) {
                // Partial Fisher-Yates shuffle: draws `count` distinct cells. All sets of cells are equally
                // likely whatever the initial order is, so the order is not restored for the next centre. The
                // cells are then sorted in grid order: a target reads its sources from the first to the last,
                // which caches well. The original's order is that of its unseeded draws.
                const std::size_t count =
                    std::min(places_.size(), static_cast<std::size_t>(std::max(a.count, 0)));
                for (std::size_t i = 0; i < count; ++i) {
                    const double u = random_.uniform(draws_++, 1);
                    std::swap(places_[i],
                              places_[i + static_cast<std::size_t>(u * double(places_.size() - i))]);
                }
                std::sort(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(count));
                for (std::size_t i = 0; i < count; ++i)
                    visit(grid_.left() + places_[i] % grid_.width(),
                          grid_.top() + places_[i] / grid_.width());
            },
        },
        arborization_.shape);
}

void Arbor::spread(Place centre, const std::function<void(int, double)>& visit) {
    points(centre, [&](int x, int y) {
        // The original draws a whole number from 0 to 100 and keeps the point when it is at most 100 p.
        if (arborization_.probability < 1 &&
            std::floor(random_.uniform(draws_++, 0) * 101) > arborization_.probability * 100)
            return;
        const int cell = grid_.index(wrapped(x, grid_.left(), grid_.width(), grid_.wraps_x()),
                                     wrapped(y, grid_.top(), grid_.height(), grid_.wraps_y()));
        if (cell >= 0) visit(cell, std::hypot(x - centre.x, y - centre.y));
    });
}

}  // namespace forage::connectivity
