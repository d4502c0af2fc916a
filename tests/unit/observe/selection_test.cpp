#include "core/observe/source.h"
#include "tests/unit/engine/simulations.h"

using namespace forage;
using namespace forage::observe;

namespace {

Recorded recorded(int width, int height) {
    Recorded out;
    out.name = "P/G:act";
    out.cells = {1, 1, width, height, {}};
    return out;
}

}  // namespace

TEST_CASE("A part of a recording has its cells row by row") {
    const auto part = part_of(recorded(4, 3), expression::parse_source("P/G(2..3,2..3)"));
    REQUIRE(part);
    CHECK(part->numbers == std::vector<std::size_t>{5, 6, 9, 10});
    CHECK(part->what.name == "P/G:act(2..3,2..3)");
    CHECK(part->what.cell_name(2) == "x2_y3");
    // Of a recording that is a part itself, the same cells have the same names.
    CHECK(part_of(part->what, expression::parse_source("P/G(3,3)"))->numbers == std::vector<std::size_t>{3});
    for (const char* outside : {"P/G(4..5,1)", "P/G(0,1)", "P/G(3..2,1)", "P/G(1,4)"})
        CHECK_FALSE(part_of(recorded(4, 3), expression::parse_source(outside)));
}

TEST_CASE("The mean of cells is one number") {
    const auto part = part_of(recorded(2, 2), expression::parse_source("mean:P/G"));
    REQUIRE(part);
    CHECK(part->what.size() == 1);
    const double row[] = {1, 2, 3, 6};
    double out = 0;
    part->take(row, {&out, 1});
    CHECK(out == 3);
    CHECK(part->what.cell_name(0) == "mean");
}
