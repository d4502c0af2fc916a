// What the contextual layer adds, with the robot in the loop: statistics with fixed seeds.
#include "tests/support/catch.h"
#include "tests/support/learning.h"

using namespace forage;
using namespace forage::test;

namespace {

const std::string enabled = "Contextual.enableModule=true";

bool memory_full(const DacLoop& loop) {
    const auto empty = loop.activity("Contextual/Empty");
    constexpr int width = 100, height = 50;
    for (int row = 0; row < height; ++row)
        if (empty[row * width] != 0) return false;
    return true;
}

}  // namespace

TEST_CASE("With its memory filled the contextual layer solves the ambiguous arena") {
    for (const auto seed : learning_seeds) {
        DacLoop loop("ambiguous_arena", seed, {enabled});
        loop.run_trials(600);
        INFO("seed " << seed);
        CHECK(memory_full(loop));
        CHECK(loop.success(100) >= 0.85);
    }
}

TEST_CASE("The contextual layer alone solves the basic arena") {
    for (const auto seed : learning_seeds) {
        DacLoop loop("basic_arena", seed, {enabled});
        loop.run_trials(350);
        INFO("seed " << seed);
        REQUIRE(memory_full(loop));
        loop.set("Selection/Approach.excGain=0");
        loop.set("Selection/Adaptive.excGain=0");
        loop.run_trials(450);
        CHECK(loop.success(100) >= 0.85);
    }
}
