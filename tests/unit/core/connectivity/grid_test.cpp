#include "core/connectivity/grid.h"

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

TEST_CASE("Cells are numbered row by row, and positions outside the group have no index") {
    const Grid grid(rect(3, 2));
    CHECK(grid.cells() == 6);
    CHECK((grid.index(1, 1) == 0 && grid.index(3, 1) == 2 && grid.index(1, 2) == 3 && grid.index(3, 2) == 5));
    for (const auto& [x, y] : {std::pair(0, 1), {1, 0}, {4, 1}, {1, 3}, {-1, -1}, {1'000'000, 1}})
        CHECK(grid.index(x, y) == -1);
}

TEST_CASE(
    "The cells of a sparse group are numbered row by row, each once, and points below 1 are not cells") {
    const model::SparseTopology sparse{{at(5, 4), at(2, 3), at(4, 3), at(2, 3), at(0, 1), at(1, -2)}};
    const Grid grid(sparse);
    CHECK((grid.left() == 2 && grid.top() == 3 && grid.width() == 4 && grid.height() == 2 &&
           grid.cells() == 3));
    CHECK((grid.index(2, 3) == 0 && grid.index(4, 3) == 1 && grid.index(5, 4) == 2));
    CHECK((grid.index(3, 3) == -1 && grid.index(2, 4) == -1 && grid.index(1, 1) == -1));
    CHECK(model::shape(sparse) ==
          GroupShape{4, 2, 3});  // the size of the group in the engine: duplicates are not cells
    CHECK(model::shape(model::SparseTopology{{at(0, 0)}}) == GroupShape{});
}
