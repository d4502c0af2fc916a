// The closed loop does not allocate memory: neither the engine nor Bullet nor OpenCV.
#include "tests/support/closed_loop.h"
#include "tests/support/count_allocations.h"

using namespace forage::test;

TEST_CASE("Cycles of system and world do not allocate memory between two resets") {
    ClosedLoop loop({});
    for (int i = 0; i < 20; ++i) loop.step();
    const std::size_t before = allocations();
    for (int i = 0; i < 30; ++i) loop.step();
    const std::size_t after = allocations();
    REQUIRE(loop.world->trials(0).empty());
    CHECK(after - before == 0);
    CHECK((before > 0) == counts_allocations);
}
