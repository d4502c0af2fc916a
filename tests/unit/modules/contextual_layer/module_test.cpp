#include "modules/contextual_layer/module.h"

#include <random>

#include "modules/contextual_layer/display.h"
#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using contextual::ContextualLayerModule;

namespace {

const std::vector<std::string> displays{"empty", "collector", "distance", "selected", "trigger"};

struct ContextualBench : ModuleBench {
    ContextualBench(const std::string& height, const std::string& width)
        : ModuleBench(module_type<ContextualLayerModule>()) {
        set("Memory Height", height)
            .set("Memory Width", width)
            .set("Memory Threshold", "0.3")
            .set("%-WTA", "0.9");
        set("Trigger Reset", "1.2").set("Trigger Decay", "0.1").set("Discrepancy Threshold", "0.1");
        in("action", 3, 1).in("prototype", 2, 2).in("stats", 2, 1).in("discrepancy", 1, 1);
    }
};

}  // namespace

TEST_CASE("The displays of moduleCL always show the complete memory, and do not change surplus cells") {
    ContextualBench b("3", "5");
    b.out("action", 2, 1)
        .out("empty", 5, 4)
        .out("collector", 5, 3)
        .out("distance", 16, 1)
        .out("selected", 5, 3)
        .out("trigger", 15, 2);
    REQUIRE(b.problems().empty());
    b.start();
    for (auto& values : b.outputs) values.setConstant(-7);
    b.update();
    for (const auto& values : b.outputs) CHECK((values == -7).all());  // closed
    b.inputs[3][0] = 0.05;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform;
    const auto& layer = b.module<ContextualLayerModule>().layer();
    for (int step = 0; step < 400; ++step) {
        for (auto& v : b.inputs[0]) v = uniform(random);
        for (auto& v : b.inputs[1]) v = random() % 2 ? uniform(random) : 0;
        b.inputs[2][0] = random() % 5 == 0;
        b.inputs[2][1] = random() % 9 == 0;
        b.update();
        std::vector<Eigen::ArrayXd> expected;
        for (std::size_t i = 1; i < b.outputs.size(); ++i)
            expected.emplace_back(Eigen::ArrayXd::Constant(b.outputs[i].size(), -7));
        const auto cells = [&](std::size_t i) { return Column(expected[i].data(), expected[i].size()); };
        contextual::show_empty(layer, true, cells(0));
        contextual::show(layer, layer.memory().collector(), true, cells(1));
        contextual::show(layer, layer.memory().distance(), true, cells(2));
        contextual::show(layer, layer.memory().selected(), true, cells(3));
        contextual::show(layer, layer.memory().trigger(), true, cells(4));
        for (std::size_t i = 0; i < 5; ++i)
            if (!(b.outputs[i + 1] == expected[i]).all()) FAIL("step " << step << ", " << displays[i]);
        CHECK((b.outputs[0] == layer.action().head(2).cast<double>()).all());
    }
}

TEST_CASE("moduleCL works without displays") {
    ContextualBench b("3", "5");
    b.out("action", 3, 1);
    for (const auto& d : displays) b.bind(d, true, 0, 0, 0);
    REQUIRE(b.problems().empty());
    b.start();
    b.inputs[0].setConstant(0.5), b.inputs[1].setConstant(1), b.inputs[2][0] = 1, b.inputs[3][0] = 0.05;
    b.update();
    CHECK(b.outputs[0][0] == Approx(0.5));
}

TEST_CASE("moduleCL reads its sizes only at the start, and starts with an empty memory") {
    ContextualBench b("2", "2");
    b.out("action", 3, 1);
    for (const auto& d : displays) b.out(d, 2, 2);
    b.start();
    b.inputs[0].setConstant(0.5), b.inputs[1].setConstant(1), b.inputs[2][0] = 1, b.inputs[3][0] = 0.05;
    b.set("Memory Height", "50").update();
    CHECK(b.outputs[1].sum() == 3);
    b.set("Memory Height", "2.9").start();
    b.inputs[3][0] = 0.5;
    b.update();
    CHECK_FALSE(b.module<ContextualLayerModule>().layer().open());
    CHECK(b.outputs[1].isZero());
}

TEST_CASE("moduleCL reports groups and parameters that do not fit the memory") {
    const auto bound = [](ContextualBench& b, int action, int collector, int trigger) {
        b.out("action", action, 1)
            .out("empty", 5, 3)
            .out("collector", collector, 3)
            .out("distance", 5, 3)
            .out("selected", 5, 3);
        b.out("trigger", trigger, 3);
    };
    ContextualBench fits("3", "5"), action("3", "5"), collector("3", "5"), trigger("3", "5");
    bound(fits, 3, 5, 6);
    CHECK(fits.problems().empty());
    bound(action, 4, 5, 5);
    CHECK_THAT(only_problem(action), ContainsSubstring("'P/action' is 4 x 1, 'P/action' 3 x 1"));
    bound(collector, 3, 6, 5);
    CHECK_THAT(only_problem(collector),
               ContainsSubstring(
                   "'collector' needs 'Memory Width' x 'Memory Height' cells; 'P/collector' is 6 x 3"));
    bound(trigger, 3, 5, 4);
    CHECK_THAT(only_problem(trigger),
               ContainsSubstring("'trigger'") && ContainsSubstring("make the group 5 x 3"));
    ContextualBench none("0", "5"), vast("1e9", "1e9");
    bound(none, 3, 5, 5);
    CHECK_THAT(only_problem(none), ContainsSubstring("'Memory Height' is 0"));
    bound(vast, 3, 5, 5);
    CHECK(vast.problems().size() == 2);
    ModuleBench one(module_type<ContextualLayerModule>());
    one.in("action", 3, 1)
        .in("prototype", 2, 2)
        .in("stats", 1, 1)
        .in("discrepancy", 1, 1)
        .out("action", 3, 1);
    for (const auto& d : displays) one.out(d, 1, 1);
    CHECK_THAT(only_problem(one), ContainsSubstring("'stats' needs at least 2 cells"));
}
