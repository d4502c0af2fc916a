// Updates do not allocate memory.
#include "modules/adaptive_layer/module.h"
#include "modules/colour/module.h"
#include "modules/contextual_layer/module.h"
#include "modules/difference/difference.h"
#include "modules/direction/direction.h"
#include "tests/support/catch.h"
#include "tests/support/count_allocations.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;

namespace {

/// The number of allocations in updates with changing input.
std::size_t allocations_of(ModuleBench& b) {
    REQUIRE(b.problems().empty());
    b.start();
    const std::size_t before = allocations();
    for (int i = 0; i < 60; ++i) {
        for (auto& values : b.inputs)
            for (Index c = 0; c < values.size(); ++c)
                values[c] = 0.05 * static_cast<double>((i * 7 + c * 3) % 11 != 0);
        b.update();
    }
    return allocations() - before;
}

}  // namespace

TEST_CASE("No module allocates memory in an update") {
    ModuleBench adaptive(module_type<adaptive::AdaptiveLayerModule>()),
        contextual(module_type<contextual::ContextualLayerModule>());
    ModuleBench colour(module_type<colour::ColourModule>()),
        difference(module_type<goal::DifferenceModule>());
    ModuleBench direction(module_type<goal::DirectionModule>());

    adaptive.in("input", 5, 3)
        .in("condition", 3, 1)
        .out("prototype", 5, 3)
        .out("output", 3, 1)
        .out("descripancy", 1, 1);
    adaptive.out("weight display", 15, 3).seed(1);
    CHECK(allocations_of(adaptive) == 0);

    contextual.set("Memory Height", "4").set("Memory Width", "6").set("Discrepancy Threshold", "0.1");
    contextual.in("action", 3, 1)
        .in("prototype", 5, 3)
        .in("stats", 2, 1)
        .in("discrepancy", 1, 1)
        .out("action", 3, 1);
    for (const char* display : {"empty", "collector", "distance", "selected", "trigger"})
        contextual.out(display, 6, 4);
    CHECK(allocations_of(contextual) == 0);
    CHECK(contextual.module<contextual::ContextualLayerModule>().layer().memory().length(3) > 0);

    colour.in("_hue", 5, 4).in("_value", 5, 4).out("_color", 5, 48);
    CHECK(allocations_of(colour) == 0);
    difference.in("_location", 3, 3).in("_goal", 3, 3).out("_diff", 5, 5);
    CHECK(allocations_of(difference) == 0);
    direction.in("_location", 3, 3).in("_ori", 8, 1).in("_goal", 3, 3).out("_dir", 9, 1).out("_dist", 1, 1);
    CHECK(allocations_of(direction) == 0);
}
