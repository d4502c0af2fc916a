#include "tools/plot/layers.h"

#include <algorithm>

#include "tests/support/catch.h"

using namespace forage::plot;

TEST_CASE("Layers put a box below all boxes from which arrows lead to it") {
    const auto rows = [](const Layers& layers) {
        std::vector<int> out;
        for (const auto& p : layers.boxes) out.push_back(p.row);
        return out;
    };
    const auto chain =
        layered(4, {{2, 0}, {0, 1}, {2, 1}, {1, 1}, {1, 3}, {3, 0}});  // 3 to 0 closes a circle
    CHECK(rows(chain) == std::vector{1, 2, 0, 3});
    CHECK(chain.bends[0].empty());
    REQUIRE(chain.bends[2].size() == 1);  // from 2 to 1, past 0
    CHECK(chain.bends[2][0].row == 1);
    CHECK(chain.bends[2][0].column != chain.boxes[0].column);
    CHECK(rows(layered(2, {{0, 1}, {1, 0}})) == std::vector{0, 1});
    std::vector<std::pair<std::size_t, std::size_t>> star;
    for (std::size_t i = 1; i < 15; ++i) star.emplace_back(0, i);
    const auto wide = rows(layered(15, star));
    CHECK(*std::max_element(wide.begin(), wide.end()) == 3);
    // Arrows do not cross when they need not.
    const auto pairs = layered(4, {{0, 3}, {1, 2}});
    CHECK((pairs.boxes[0].column < pairs.boxes[1].column) == (pairs.boxes[3].column < pairs.boxes[2].column));
}
