#include "bug_interface/sensing/place_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/catch.h"

using namespace forage::bug;

namespace {

std::size_t strongest(const std::vector<double>& cells) {
    return static_cast<std::size_t>(std::max_element(cells.begin(), cells.end()) - cells.begin());
}

}  // namespace

TEST_CASE("The place cell at the robot's position is the most active one, with activity 1") {
    std::vector<double> cells(21 * 21);
    const PlaceField field{0, 0, 10, 10, 0.2};
    place_cells(0, 0, 21, 21, field, cells);
    CHECK(strongest(cells) == 10 * 21 + 10);
    CHECK(cells[10 * 21 + 10] == 1);
    CHECK(cells[10 * 21 + 12] == Approx(std::exp(-1.0)));  // 0.2 = sigma aside
    place_cells(5, 8, 21, 21, field, cells);
    CHECK(strongest(cells) == 2 * 21 + 15);  // row 0 is +y
}

TEST_CASE("Place cells of an even side are asymmetric") {
    std::vector<double> cells(20);
    place_cells(9, 0, 20, 1, {0, 0, 10, 10, 0.2}, cells);
    CHECK(strongest(cells) == 19);
    place_cells(-10, 0, 20, 1, {0, 0, 10, 10, 0.2}, cells);
    CHECK(strongest(cells) == 0);
}

TEST_CASE("The offset and the extent move and stretch the area of the place cells") {
    std::vector<double> cells(11 * 11);
    place_cells(3, -1, 11, 11, {2, -2, 5, 5, 0.1}, cells);
    CHECK(strongest(cells) == 4 * 11 + 6);
}

TEST_CASE("Place cells far away from the robot stay finite and keep their maximum at 1") {
    std::vector<double> cells(9);
    place_cells(1e4, 1e4, 3, 3, {0, 0, 1, 1, 0.01}, cells);
    CHECK(cells[2] == 1);
    for (const double c : cells) CHECK(std::isfinite(c));
}

TEST_CASE("Head direction cells cover the circle in the order -x, -y, +x, +y") {
    const double pi = std::numbers::pi;
    std::vector<double> cells(36);
    for (const auto& [yaw, cell] : {std::pair{-pi, 0u}, {-pi / 2, 9u}, {0.0, 18u}, {pi / 2, 27u}, {pi, 0u}}) {
        head_direction_cells(yaw, 0.1, cells);
        CHECK(strongest(cells) == cell);
        CHECK(cells[cell] == 1);
        CHECK(cells[(cell + 1) % 36] == Approx(cells[(cell + 35) % 36]));
    }
    head_direction_cells(0, 0.1, cells);
    CHECK(cells[18 + 9] == Approx(std::exp(-6.25)));
}
