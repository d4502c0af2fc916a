#include "modules/explore/explore.h"

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;

namespace {

int chosen(const Eigen::ArrayXd& cells) {
    Index cell = 0;
    return cells.maxCoeff(&cell) > 0 ? static_cast<int>(cell) : -1;
}

}  // namespace

TEST_CASE("moduleExplore goes straight on, then turns to one side, each for 1 to 20 decisions") {
    ModuleBench b(module_type<explore::ExploreModule>());
    b.in("trial", 2, 1).out("action", 3, 1);
    REQUIRE(b.problems().empty());
    b.seed(1).start();
    std::vector<std::pair<int, int>> bouts;  // action, cycles
    for (int i = 0; i < 40000; ++i) {
        b.update();
        REQUIRE(b.outputs[0].sum() == 1);
        const int now = chosen(b.outputs[0]);
        if (bouts.empty() || bouts.back().first != now) bouts.push_back({now, 0});
        ++bouts.back().second;
    }
    bouts.pop_back();
    int lefts = 0, turns = 0, longest = 0;
    double straight = 0;
    for (std::size_t i = 0; i < bouts.size(); ++i) {
        CHECK((bouts[i].first == 0) == (i % 2 == 0));
        CHECK(bouts[i].second % 4 == 0);
        longest = std::max(longest, bouts[i].second);
        if (i % 2) ++turns, lefts += bouts[i].first == 1;
        if (i % 2 == 0) straight += bouts[i].second / 4.0;
    }
    CHECK(longest == 80);
    CHECK(lefts / static_cast<double>(turns) == Approx(0.5).margin(0.1));
    CHECK(straight / static_cast<double>((bouts.size() + 1) / 2) == Approx(10.5).margin(1));
}

TEST_CASE("An interval of moduleExplore begins when a trial ends") {
    ModuleBench b(module_type<explore::ExploreModule>());
    b.set("Longest Straight", "1").set("Longest Turn", "1").set("Decision Interval", "3");
    b.in("trial", 2, 1).out("action", 3, 1);
    b.start();
    b.update();
    CHECK(chosen(b.outputs[0]) == 0);
    b.inputs[0][1] = 1;
    b.update();
    CHECK(chosen(b.outputs[0]) > 0);
    b.inputs[0][1] = 0;
    b.update(), b.update();
    CHECK(chosen(b.outputs[0]) > 0);
    b.update();
    CHECK(chosen(b.outputs[0]) == 0);
}
