// The groups of the camera while the robot drives over a patch.
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/support/catch.h"
#include "tests/support/closed_loop.h"

using namespace forage;
using namespace forage::test;

namespace {

/// The first and the last row of the group that have a cell with an activity of at least 0.5.
std::optional<std::pair<int, int>> lit_rows(const ConstColumn& cells, int width) {
    std::optional<std::pair<int, int>> out;
    for (Index i = 0; i < cells.size(); ++i) {
        const int row = static_cast<int>(i) / width;
        if (cells[i] < 0.5) continue;
        if (!out) out = {row, row};
        out->second = row;
    }
    return out;
}

/// The row that shows a floor point `ahead` metres in front of the robot's centre: the inverse of the
/// camera's projection (0.2 m ahead, 0.35 m high, looking 1.1 rad down).
double row_of(double ahead) {
    constexpr double height = 0.35, forward = 0.2, pitch = 1.1, hfov = 0.8047, rows = 28, columns = 32;
    const double below = std::atan2(height, ahead - forward);  // angle under the horizon
    const double b = std::tan(pitch - below);                  // up in the picture
    return (1 - b / (std::tan(hfov / 2) * rows / columns)) / 2 * rows;
}

}  // namespace

TEST_CASE("A patch ahead appears in the top row and moves down as the geometry predicts") {
    // Up the middle: the blue patch lies at (0, -0.497) and has a radius of 0.2013 m.
    constexpr double near_edge = -0.4966 - 0.2013, far_edge = -0.4966 + 0.2013;
    ClosedLoop loop({.noise = false});
    std::vector<double> y;  // of the robot at the end of each cycle
    int seen = 0;
    while (loop.pose().y < 0) {
        loop.step();
        y.push_back(loop.pose().y);
        if (y.size() < 3) continue;
        // The module reads the camera's picture of the end of cycle t in t + 1, and the group receives it in
        // t + 2.
        const double robot = y[y.size() - 3];
        const double top = row_of(far_edge - robot), bottom = row_of(near_edge - robot);
        const auto rows = lit_rows(loop.activity("Bug/Blue - Value"), 32);
        INFO("robot at y = " << robot << ", patch expected in rows " << top << " to " << bottom);
        if (bottom > 0.5 && top < 27.5) {
            REQUIRE(rows);
            CHECK(std::abs(rows->first - std::clamp(top, 0.0, 27.0)) <= 1);
            CHECK(std::abs(rows->second - std::clamp(bottom - 1, 0.0, 27.0)) <= 1);
            ++seen;
        } else if (bottom < -0.5 || top > 28.5) {
            CHECK_FALSE(rows);
        }
    }
    CHECK(seen >= 5);
    // The yellow patch further up has no blue; it appears equally in red and green.
    while (loop.pose().y < 0.65) loop.step();
    CHECK(loop.activity("Bug/Red - Hue").maxCoeff() > 0.9);
    CHECK(loop.activity("Bug/Green - Saturation").maxCoeff() > 0.9);
    CHECK(loop.activity("Bug/Blue - Value").maxCoeff() < 0.1);
}
