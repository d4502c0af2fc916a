#include "modules/allostasis/fields.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forage::allostasis {
namespace {

constexpr int cells = 360;                                            // of 1 cm on a side of the grid
constexpr std::array<int, 4> to_x{-1, 1, -1, 1}, to_y{1, 1, -1, -1};  // NW, NE, SW, SE

double grid(double metres) { return cells / 2 + 100 * metres; }

double kernel(double distance, double radius) {
    const double r = distance / radius;
    return distance <= radius ? 15.0 / 16 * (1 - r * r) * (1 - r * r) : 0;
}

/// The field of a point source, divided by its largest value on the grid.
class Source {
  public:
    Source(double x, double y, double radius) : x_(x), y_(y), radius_(radius), largest_(1) {
        const auto nearest = [](double g) {
            return std::clamp(static_cast<int>(std::floor(g)), 0, cells - 1);
        };
        largest_ = at(nearest(x), nearest(y));
    }
    double at(int column, int row) const {
        return kernel(std::hypot(column + 0.5 - x_, row + 0.5 - y_), radius_) / largest_;
    }

  private:
    double x_, y_, radius_, largest_;
};

/// The mean of 4 x 3 cells in each of the four quadrants around a cell, whose row and column are left out.
template <class Field>
void quadrants(LocalViews& views, Need need, int column, int row, const Field& field) {
    for (std::size_t q = 0; q < 4; ++q) {
        double sum = 0;
        for (int i = 1; i <= 4; ++i)
            for (int j = 1; j <= 3; ++j) sum += field(column + to_x[q] * i, row + to_y[q] * j);
        views(need, static_cast<Eigen::Index>(q)) = sum / 12;
    }
}

}  // namespace

double Day::step(double time) {
    if (day_) {
        const double c = time - start_;
        if (c >= length) day_ = false, start_ = time;
        return c;
    }
    const double c = length - (time - start_);
    if (c <= 0) day_ = true, start_ = time;
    return c;
}

TemperatureField::TemperatureField(int step) : middle_(-1 + 2 * step / Day::length) {}

double TemperatureField::row(int y) const {
    const double axis = 1 - 2.0 * y / (cells - 1);
    return std::min(0.98, 1 / (1 + std::exp(-15 * (axis - middle_))));
}

double TemperatureField::mean() const {
    double sum = 0;
    for (int y = 0; y < cells; ++y) sum += row(y);
    return sum / cells;
}

LocalViews local_views(Place robot, Place predator, Place mate, int step, bool offset) {
    const int column = static_cast<int>(grid(robot.x)), row = static_cast<int>(grid(robot.y));
    LocalViews views;
    const TemperatureField warm(step);
    quadrants(views, temperature, column, row, [&](int, int y) { return warm.row(y); });
    const auto sense = [&](Need need, const Source& source) {
        quadrants(views, need, column, row, [&](int x, int y) { return source.at(x, y); });
    };
    const int y = offset ? 285 : 290;
    sense(hydration, Source(y, y, 280));
    sense(energy, Source(offset ? 65 : 70, y, 280));
    sense(security, Source(grid(predator.x), grid(predator.y), 200));
    sense(mating, Source(grid(mate.x), grid(mate.y), 280));
    return views;
}

}  // namespace forage::allostasis
