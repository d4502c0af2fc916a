#include "modules/allostasis/walk_module.h"

#include <set>

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;

TEST_CASE("moduleRandomWalk stays within its speeds and turns away from a wall") {
    ModuleBench b(module_type<allostasis::WalkModule>());
    b.set("Lowest", "1").set("Highest", "4").set("Fastest Turn", "2.5");
    b.in("proximity", 32, 1).out("motor", 41, 41);
    b.seed(1).start();
    const auto speeds = [&] {
        Index best = 0;
        CHECK(b.outputs[0].maxCoeff(&best) == 1);
        const double forward = (20.0 - static_cast<double>(best / 41)) / 20 * 6.2,
                     left = (20.0 - static_cast<double>(best % 41)) / 20 * 6.2;
        return std::pair{forward + left, forward - left};  // of the right and the left wheel
    };
    std::set<double> seen;
    for (int i = 0; i < 400; ++i) {
        b.update();
        const auto [right, left] = speeds();
        CHECK((right > 0.6 && right < 4.4 && left > 0.6 && left < 4.4));  // within a cell of the motor group
        seen.insert(right);
    }
    CHECK(seen.size() > 5);
    for (const Index right : {17, 20, 23}) b.inputs[0][right] = 0.9;  // a wall on the right
    for (int i = 0; i < 60; ++i) b.update();
    const auto [right, left] = speeds();
    CHECK(right > left + 0.5);
}
