#include "core/connectivity/arbor.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace forage::connectivity {
namespace {

using PointVisitor = std::function<void(int, int)>;

void visit_rect(Place c, int width, int height, const PointVisitor& visit) {
    const Span xs = cover(c.x, width), ys = cover(c.y, height);
    for (int x = xs.first; x <= xs.last; ++x)
        for (int y = ys.first; y <= ys.last; ++y) visit(x, y);
}

/// Rows covered by an ellipse at column x; `xs` are the columns that it covers.
Span ellipse_rows(Place c, Span xs, int x, int width, int height) {
    const double a = width / 2.0, b = height / 2.0;
    const double offset = x - (xs.first + xs.last) / 2.0;
    const double squared = b * b - offset * offset * (b * b) / (a * a);
    return squared < 0 ? Span{1, 0} : cover(c.y, 2 * std::sqrt(squared));
}

void visit_ellipse(Place c, int width, int height, const PointVisitor& visit) {
    const Span xs = cover(c.x, width);
    for (int x = xs.first; x <= xs.last; ++x) {
        const Span ys = ellipse_rows(c, xs, x, width, height);
        for (int y = ys.first; y <= ys.last; ++y) visit(x, y);
    }
}

bool inside(Span s, int k) { return s.first <= k && k <= s.last; }

/// -1 where a point lies outside, and the side does not wrap.
int wrapped(int k, int first, int size, bool wraps) {
    if (wraps && k < first) k += size;
    else if (wraps && k >= first + size) k -= size;
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
    : arborization_(arborization), grid_(grid), random_(random) {}

void Arbor::points(Place c, const PointVisitor& visit) {
    std::visit(
        Overloaded{
            [&](const model::RectArbor& a) { visit_rect(c, a.width, a.height, visit); },
            [&](const model::EllipseArbor& a) { visit_ellipse(c, a.width, a.height, visit); },
            [&](const model::RectWindowArbor& a) {
                const Span xs = cover(c.x, a.inner_width), ys = cover(c.y, a.inner_height);
                visit_rect(c, a.outer_width, a.outer_height, [&](int x, int y) {
                    if (!(inside(xs, x) && inside(ys, y))) visit(x, y);
                });
            },
            [&](const model::EllipseWindowArbor& a) {
                const Span xs = cover(c.x, a.inner_width);
                visit_ellipse(c, a.outer_width, a.outer_height, [&](int x, int y) {
                    if (!(inside(xs, x) && inside(ellipse_rows(c, xs, x, a.inner_width, a.inner_height), y))) visit(x, y);
                });
            },
            [&](const model::AllArbor&) {
                for (int y = grid_.top(); y < grid_.top() + grid_.height(); ++y)
                    for (int x = grid_.left(); x < grid_.left() + grid_.width(); ++x) visit(x, y);
            },
            [&](const model::RandomArbor& a) {
                // Partial Fisher-Yates shuffle: `count` distinct cells, each set of them equally likely.
                std::vector<int> places(static_cast<std::size_t>(grid_.width()) * static_cast<std::size_t>(grid_.height()));
                std::iota(places.begin(), places.end(), 0);
                for (std::size_t i = 0; i < places.size() && i < static_cast<std::size_t>(a.count); ++i) {
                    const double u = random_.uniform(draws_++, 1);
                    std::swap(places[i], places[i + static_cast<std::size_t>(u * double(places.size() - i))]);
                    visit(grid_.left() + places[i] % grid_.width(), grid_.top() + places[i] / grid_.width());
                }
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
