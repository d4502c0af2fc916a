#include "bug_interface/sensing/grid.h"

#include <algorithm>
#include <vector>

#include "core/base/random.h"
#include "tests/support/catch.h"

using namespace forage::bug;

TEST_CASE("A search in a grid visits the items in its area once, wherever they are and whatever the cells") {
    const forage::RandomStream random(1, "areas");
    for (const double cell : {0.05, 0.7, 100.0}) {
        std::vector<Area> areas;
        for (std::uint64_t i = 0; i < 300; ++i) {
            const auto u = [&](std::uint32_t k) { return random.uniform(i, k); };
            areas.push_back(Area::around(20 * u(0) - 10, 4 * u(1), 0.5 * u(2)));
        }
        areas.push_back({-12, -1, 12, 5});  // around all others
        areas.push_back({3, 3, 3, 3});      // a point
        Grid grid;
        grid.assign(areas, cell);
        for (std::uint64_t i = 0; i < 200; ++i) {
            const auto u = [&](std::uint32_t k) { return random.uniform(1000 + i, k); };
            const Area search = Area::around(30 * u(0) - 15, 10 * u(1) - 3, 3 * u(2));
            std::vector<std::size_t> expected, found;
            for (std::size_t k = 0; k < areas.size(); ++k)
                if (areas[k].meets(search)) expected.push_back(k);
            grid.visit(search, [&](std::size_t k) { found.push_back(k); });
            std::sort(found.begin(), found.end());
            REQUIRE(found == expected);
        }
    }
}

TEST_CASE("A grid without items finds nothing, and forgets its items when it gets others") {
    Grid grid;
    int found = 0;
    const auto search = [&] { grid.visit({-1, -1, 1, 1}, [&](std::size_t) { ++found; }); };
    search();
    CHECK(found == 0);
    grid.assign({{0, 0, 1, 1}}, 1);
    search();
    CHECK(found == 1);
    grid.assign({}, 1);
    search();
    CHECK(found == 1);
}
