#include "bug_interface/sensing/place_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace forage::bug {
namespace {

/// Replaces each exponent by exp(-exponent), divided by the largest of these. The division is done by
/// subtracting the smallest exponent first, which avoids 0 / 0 far from all receptive fields.
void normalised_gaussians(std::span<double> exponents) {
    double least = std::numeric_limits<double>::infinity();
    for (const double e : exponents) least = std::min(least, e);
    for (double& e : exponents) e = std::exp(least - e);
}

/// The coordinate of a cell along a side of the group, -1..1. Sides with an even number of cells are
/// asymmetric, as in the original.
double along_side(int index, int side) {
    const int half = side / 2;
    return half ? static_cast<double>(index - half) / half : 0.0;
}

}  // namespace

void place_cells(double x, double y, int w, int h, const PlaceField& field, std::span<double> out) {
    // A Gaussian in the plane is the product of one along x and one along y.
    const double px = (x - field.x_offset) / field.x_max, py = (y - field.y_offset) / field.y_max;
    const auto columns = out.first(static_cast<std::size_t>(w));
    const auto exponent = [&](double distance) { return distance * distance / (field.sigma * field.sigma); };
    for (int column = 0; column < w; ++column)
        columns[static_cast<std::size_t>(column)] = exponent(along_side(column, w) - px);
    normalised_gaussians(columns);
    double least = std::numeric_limits<double>::infinity();
    for (int row = 0; row < h; ++row) least = std::min(least, exponent(-along_side(row, h) - py));
    for (int row = h - 1; row >= 0;
         --row) {  // the first row, which has the factors of the columns, comes last
        const double row_factor = std::exp(least - exponent(-along_side(row, h) - py));
        double* cells = out.data() + static_cast<std::ptrdiff_t>(row) * w;
        for (std::size_t column = 0; column < columns.size(); ++column)
            cells[column] = columns[column] * row_factor;
    }
}

void head_direction_cells(double yaw, double sigma, std::span<double> out) {
    const double turn = (yaw + std::numbers::pi) / (2 * std::numbers::pi);
    for (std::size_t c = 0; c < out.size(); ++c) {
        double d = std::abs(static_cast<double>(c) / static_cast<double>(out.size()) - turn);
        d -= std::floor(d);
        d = std::min(d, 1 - d) / sigma;
        out[c] = d * d;
    }
    normalised_gaussians(out);
}

}  // namespace forage::bug
