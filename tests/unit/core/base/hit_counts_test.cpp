#include "core/base/hit_counts.h"

#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("A learning curve is the share of hits among the last trials, with its interval") {
    HitCounts hits;
    for (int i = 0; i < 30; ++i) hits.add(i % 3 == 0);  // 10 of 30
    REQUIRE(hits.size() == 30);
    CHECK(hits.among(0, 30) == 10);
    CHECK(hits.among(1, 4) == 1);
    CHECK(hits.learned(1).mean == 1);
    CHECK(hits.learned(2).mean == 0.5);
    const Estimate late = hits.learned(30), same = share(hits.among(10, 30), learning_window);
    CHECK(late.mean == same.mean);
    CHECK(late.low == same.low);
    CHECK(late.high == same.high);
    hits.clear();
    CHECK(hits.size() == 0);
}
