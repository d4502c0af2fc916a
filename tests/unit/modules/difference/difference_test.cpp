#include "modules/difference/difference.h"

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using namespace forage::goal;
using Eigen::ArrayXd;

namespace {

ArrayXd one_cell(Index size, Index cell) {
    ArrayXd out = ArrayXd::Zero(size);
    out[cell] = 1;
    return out;
}

}  // namespace

TEST_CASE(
    "The peak is the first of the most active cells; there is none if all cells are equal or none is above "
    "0") {
    ArrayXd cells = ArrayXd::Zero(6);
    CHECK_FALSE(peak_position(cells, 3));
    cells.setConstant(0.5);
    CHECK_FALSE(peak_position(cells, 3));
    cells << -1, -2, -3, -1, -1, -1;
    CHECK_FALSE(peak_position(cells, 3));
    cells << 0, 0, 0.1, 0, 0.4, 0.4;
    CHECK(*peak_position(cells, 3) == GridPosition{1, 1});
    cells << 0, 0, 0.4, 0, 0.4 + 1e-12, 0;  // equal in single precision
    CHECK(*peak_position(cells, 3) == GridPosition{0, 2});
}

TEST_CASE("The difference is one cell, which is the centre at the goal") {
    ArrayXd out = ArrayXd::Constant(5 * 3, 7);
    show_difference(GridPosition{1, 2}, GridPosition{1, 2}, 3, 2, out);
    CHECK((out == one_cell(15, 1 * 5 + 2)).all());
    show_difference(GridPosition{1, 0}, GridPosition{0, 2}, 3, 2, out);
    CHECK((out == one_cell(15, 0 * 5 + 4)).all());
    show_difference(std::nullopt, GridPosition{0, 0}, 3, 2, out);
    CHECK(out.isZero());
    for (Index a = 0; a < 6; ++a)
        for (Index b = 0; b < 6; ++b) {
            show_difference(GridPosition{a / 3, a % 3}, GridPosition{b / 3, b % 3}, 3, 2, out);
            CHECK(out.sum() == 1);
        }
}

TEST_CASE("differenceModule requires two groups of the same size") {
    ModuleBench b(module_type<DifferenceModule>());
    b.in("_location", 3, 2).in("_goal", 3, 2).out("_diff", 5, 3);
    CHECK(b.problems().empty());
    b.start();
    b.inputs[0] = one_cell(6, 4);
    b.inputs[1] = one_cell(6, 0);
    b.update();
    CHECK((b.outputs[0] == one_cell(15, 1)).all());

    ModuleBench wrong(module_type<DifferenceModule>());
    wrong.in("_location", 3, 2).in("_goal", 2, 3).out("_diff", 3, 2);
    const auto all = wrong.problems();
    REQUIRE(all.size() == 2);
    CHECK_THAT(all[0].message, ContainsSubstring("'_goal' needs the size of '_location'"));
    CHECK_THAT(all[1].message, ContainsSubstring("'_diff' needs twice the width and height"));
}
