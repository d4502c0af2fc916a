#include "tools/plot/film_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace forage::plot {
namespace {

constexpr double groups_width = 220, max_group_height = 160, max_group_cell = 22, group_name_height = 18,
                 group_gap = 12;

}  // namespace

double FilmGroups::Group::height() const { return group_name_height + cell * rows + group_gap; }

FilmGroups::FilmGroups(std::vector<observe::Source> sources) : sources_(std::move(sources)) {
    for (const auto& s : sources_) {
        const auto& what = s.what();
        Group g{what.name, what.one_number() ? 1 : what.cells.width,
                what.one_number() ? 1 : what.cells.height};
        g.cell = std::min({max_group_cell, groups_width / g.columns, max_group_height / g.rows});
        g.values.resize(what.size());
        groups_.push_back(std::move(g));
    }
}

double FilmGroups::width() const { return empty() ? 0 : groups_width; }

double FilmGroups::height() const {
    double out = 0;
    for (const auto& g : groups_) out += g.height();
    return out;
}

void FilmGroups::read(const engine::Simulation& simulation) {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        Group& g = groups_[i];
        sources_[i].read(simulation, g.values);
        for (const double v : g.values)
            if (std::isfinite(v)) g.low = std::min(g.low, v), g.high = std::max(g.high, v);
    }
}

void FilmGroups::draw(Canvas& canvas, double x, double y) const {
    for (const auto& g : groups_) {
        const std::string range = fmt::format("{:.3g} to {:.3g}", g.low, g.high);
        canvas.text(x + groups_width, y + 11, range, 9, 1, grey);
        canvas.text(x, y + 11, canvas.fitted_end(g.name, 11, groups_width - canvas.width_of(range, 9) - 8),
                    11);
        const double top = y + group_name_height;
        canvas.fill(x - 1, top - 1, g.cell * g.columns + 2, g.cell * g.rows + 2, grey);
        for (int row = 0; row < g.rows; ++row)
            for (int column = 0; column < g.columns; ++column) {
                const double v = g.values[static_cast<std::size_t>(row * g.columns + column)];
                const Colour colour = !std::isfinite(v) ? pale
                                      : g.low < 0       ? diverging(v / std::max(-g.low, g.high))
                                                        : sequential(v / g.high);
                // Whole pixels, so that no lines appear between cells.
                const double left = std::floor(x + column * g.cell), upper = std::floor(top + row * g.cell);
                canvas.fill(left, upper, std::floor(x + (column + 1) * g.cell) - left,
                            std::floor(top + (row + 1) * g.cell) - upper, colour);
            }
        y += g.height();
    }
}

}  // namespace forage::plot
