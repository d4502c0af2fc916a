#include "core/connectivity/arbor.h"

#include <cmath>
#include <map>
#include <set>

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

TEST_CASE("An arborization runs column by column, and stops at the edge") {
    CHECK(posts(spread(model::RectArbor{3, 3}, rect(3, 3), at(2, 2))) ==
          std::vector<int>{0, 3, 6, 1, 4, 7, 2, 5, 8});
    CHECK(posts(spread(model::RectArbor{3, 1}, rect(3, 3), at(1, 1))) == std::vector<int>{0, 1});
    CHECK(posts(spread(model::RectArbor{100000, 100000}, rect(2, 2), at(1, 1))) ==
          std::vector<int>{0, 2, 1, 3});
    // Half height at the columns beside the centre: sqrt(1.5^2 - 1) = 1.118, so no corner is cut.
    CHECK(posts(spread(model::EllipseArbor{3, 3}, rect(5, 5), at(3, 3))) ==
          std::vector<int>{6, 11, 16, 7, 12, 17, 8, 13, 18});
    CHECK(posts(spread(model::EllipseArbor{5, 3}, rect(5, 3), at(3, 2))) ==
          std::vector<int>{5, 1, 6, 11, 2, 7, 12, 3, 8, 13, 9});
    CHECK(posts(spread(model::EllipseArbor{1, 1}, rect(5, 5), at(3, 3))) == std::vector<int>{12});
    CHECK(posts(spread(model::AllArbor{}, rect(2, 2), at(2, 2))) ==
          std::vector<int>{0, 1, 2, 3});  // row by row, as regions
}

TEST_CASE("A window is the outer shape without the inner one") {
    CHECK(posts(spread(model::RectWindowArbor{1, 1, 3, 3}, rect(3, 3), at(2, 2))) ==
          std::vector<int>{0, 3, 6, 1, 7, 2, 5, 8});
    CHECK(posts(spread(model::RectWindowArbor{3, 3, 3, 3}, rect(3, 3), at(2, 2))).empty());
    CHECK(posts(spread(model::RectWindowArbor{0, 0, 1, 1}, rect(3, 3), at(2, 2)))
              .empty());  // size 0 still covers a whole centre
}

TEST_CASE("RF spreads around the source, PF around the target") {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(2, 1)}, {at(1, 1)}}}};
    w.arborization.shape = model::RectArbor{3, 1};
    w.arborization.direction = model::Direction::receptive;
    CHECK(w.build().pairs() == Cells{{0, 0}, {1, 0}, {2, 0}});
    w.arborization.direction = model::Direction::projective;
    CHECK(w.build().pairs() == Cells{{1, 0}, {1, 1}});
}

TEST_CASE("A cylinder wraps once, and distances are measured before it wraps") {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(1, 1)}, {at(1, 1)}}}};
    w.target = rect(3, 2, true, false);
    w.arborization = {model::RectArbor{3, 3}, model::Direction::projective, 1, {}};
    auto built = w.build();
    CHECK(posts(built.pairs()) == std::vector<int>{2, 5, 0, 3, 1, 4});  // x = 0 is x = 3; y = 0 is nowhere
    CHECK(built.synapses.distance[0] == 1);
    CHECK(built.synapses.distance[1] == std::hypot(1, 1));
    w.target = rect(3, 2, false, true);
    CHECK(posts(w.build().pairs()) ==
          std::vector<int>{3, 0, 3, 4, 1, 4});  // y = 0 and y = 2 are the same cell
    w.target = rect(3, 2, true, false);
    w.arborization.shape = model::RectArbor{99, 1};
    built = w.build();
    CHECK(built.synapses.size() == 9);  // three times round, not more
}

TEST_CASE("A random arborization draws distinct cells, each equally often") {
    Wiring w;
    w.source = rect(6, 5), w.target = rect(100, 10);
    w.pattern = model::ForeachPattern{model::Region{1, 1, 1, 1, {}}, {}};
    w.arborization = {model::RandomArbor{4}, model::Direction::receptive, 1, {}};
    const auto built = w.build();
    std::map<int, std::set<int>> chosen;
    std::vector<double> uses(30);
    for (const auto& [pre, post] : built.pairs())
        chosen[post].insert(pre), ++uses[static_cast<std::size_t>(pre)];
    CHECK(chosen.size() == 1000);
    for (const auto& [post, pres] : chosen) CHECK(pres.size() == 4);
    const double expected = 4000.0 / 30, sigma = std::sqrt(1000 * (4.0 / 30) * (26.0 / 30));
    for (const double n : uses) CHECK(std::abs(n - expected) < 4 * sigma);
    w.arborization.shape = model::RandomArbor{99};  // more than there are
    CHECK(w.build().synapses.size() == 30 * 1000);
    w.arborization.shape = model::RandomArbor{0};
    CHECK(w.build().said() == "connection 'C' has no synapses");
}

TEST_CASE("A probability keeps the corresponding share of the points") {
    Wiring w;
    w.source = rect(30, 30), w.target = rect(30, 30);
    w.pattern = all_to_all;
    w.arborization.probability = 0.25;
    const double n = 900.0 * 900, p = 26.0 / 101, sigma = std::sqrt(n * p * (1 - p));  // 0..25 of 0..100
    CHECK(std::abs(static_cast<double>(w.build().synapses.size()) - n * p) < 4 * sigma);
}
