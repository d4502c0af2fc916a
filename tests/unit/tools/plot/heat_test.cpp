#include "tools/plot/heat.h"

#include "tests/unit/tools/plot/pictures.h"

using forage::Estimate;
using namespace forage::plot;

TEST_CASE("A heat map marks the cells without a number") {
    HeatMap map;
    map.x_names = {"1", "2"}, map.y_names = {"3"};
    map.cells = {Estimate{0.5, 0, 1, 3}, Estimate{1, 1, 1, 3}};
    CHECK(pixels_of(heat_map(map), pale) == 0);
    map.cells[0].reset();
    CHECK(pixels_of(heat_map(map), pale) > 5000);
    const int with_all = pixels_of(heat_map(map), black);
    map.cells[1]->count = 2, map.cells[0] = Estimate{0.5, 0, 1, 3};
    CHECK(pixels_of(heat_map(map), black) != with_all);
}
