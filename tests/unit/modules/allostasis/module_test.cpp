// moduleAllostasis: its needs, its drives and where it steers.
#include "modules/allostasis/module.h"

#include <numbers>

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using allostasis::AllostasisModule;

namespace {

struct AllostasisBench : ModuleBench {
    AllostasisBench() : ModuleBench(module_type<AllostasisModule>()) {
        in("gps", 3, 1).in("mate", 3, 1).in("predator", 3, 1).in("proximity", 32, 1);
        out("needs", 5, 1).out("forces", 5, 1).out("views", 4, 5).out("motor", 41, 41).out("time", 2, 1);
        out("errors", 5, 1).out("balance", 3, 1);
        set("View Interval", "0").set("View Delay", "0");
    }
    /// Places the robot at (x, y), in metres of the original arena, with a heading in rad; the mate is in the
    /// west and the predator in the east.
    void at(double x, double y, double heading) {
        inputs[0] << 4 * x + 10, 4 * y + 10, heading + std::numbers::pi;
        inputs[1] << 4, 10, 0;
        inputs[2] << 16, 10, 0;
    }
    Index row() const { return cell() / 41; }
    Index column() const { return cell() % 41; }
    Index cell() const {
        Index best = 0;
        outputs[3].maxCoeff(&best);
        return best;
    }
};

}  // namespace

TEST_CASE("Needs fall with time, and recover at their resource") {
    AllostasisBench b;
    REQUIRE(b.problems().empty());
    b.seed(1).start();
    b.at(0, 0, 0);
    for (int i = 0; i < 300; ++i) b.update();  // 100 steps of 0.12 s
    CHECK(b.outputs[0][1] == Approx(0.9 - 100 * 0.0005));
    CHECK(b.outputs[0][2] == Approx(0.2 - 100 * 0.0004));
    CHECK(b.outputs[0][4] == Approx(0.9 - 100 * 0.0003));
    b.at(-1.15, 1.05, 0);  // food
    for (int i = 0; i < 150; ++i) b.update();
    CHECK(b.outputs[0][2] == Approx(0.16 + 50 * (0.01 - 0.0004)));
    b.at(1.5, 0, 0);  // at the predator
    for (int i = 0; i < 3; ++i) b.update();
    CHECK(b.outputs[0][3] < 0.01);
    CHECK(b.outputs[1].maxCoeff() <= 1);
    CHECK(b.outputs[3].sum() == 1);
}

TEST_CASE("The robot turns towards what it needs, away from the predator, and from a wall") {
    // Half-way to the food in the north-west, looking south-west: it lies on the right.
    AllostasisBench b;
    b.seed(2).set("Energy Priority", "10");
    b.start();
    const auto mean_column = [&](int cycles) {
        double sum = 0;
        for (int i = 0; i < cycles; ++i) b.update(), sum += static_cast<double>(b.column()) - 20;
        return sum / cycles;
    };
    b.at(-1, 0.2, -3 * std::numbers::pi / 4);
    CHECK(mean_column(400) > 0.3);        // columns to the right turn right
    b.at(-1, 0.2, std::numbers::pi / 4);  // looking north-east: the food lies on the left
    CHECK(mean_column(400) < -0.3);
    b.inputs[3].setZero();
    b.inputs[3][17] = b.inputs[3][20] = 0.8;  // a wall on the right
    mean_column(13);
    CHECK(mean_column(60) < -3);
    CHECK(b.row() < 41);
}

TEST_CASE("A moduleAllostasis that is written and read back continues with the same bits") {
    const auto drive = [](AllostasisBench& b, int cycles) {
        std::vector<double> seen;
        for (int i = 0; i < cycles; ++i) {
            b.at(0.01 * (i % 90), -0.3, 0.1 * i);
            b.update();
            for (const auto& values : b.outputs) seen.push_back(values.matrix().dot(values.matrix()));
            seen.push_back(static_cast<double>(b.cell()));
        }
        return seen;
    };
    AllostasisBench one, two;
    for (auto* b : {&one, &two}) b->seed(3).start();
    drive(one, 200);
    for (int i = 0; i < 200; ++i) two.at(0, 0, 0), two.update();
    Archive out;
    one.module<AllostasisModule>().checkpoint(out);
    Archive in(out.bytes());
    two.module<AllostasisModule>().checkpoint(in);
    CHECK(in.left().empty());
    two.outputs = one.outputs;
    CHECK(drive(one, 200) == drive(two, 200));
}

TEST_CASE("Errors and balance follow the needs") {
    AllostasisBench b;
    b.seed(4).start();
    b.at(0.5, 0.5, 1);
    for (int i = 0; i < 50; ++i) b.update();
    const Eigen::ArrayXd x = b.outputs[0];
    CHECK(((b.outputs[5] - (1 - x)).abs() < 1e-12).all());
    CHECK(b.outputs[6][0] == Approx(x.mean()));
    CHECK(b.outputs[6][1] == Approx(1 - (x.maxCoeff() - x.minCoeff())));
    CHECK(b.outputs[6][2] == Approx(1 - (1 - x).square().mean()));
}

TEST_CASE("Views are taken at intervals, and used when they are old enough") {
    AllostasisBench b;
    b.seed(5).set("View Interval", "1").set("View Delay", "0.6").start();
    const auto seen = [&] { return b.outputs[2].segment(8, 4).mean(); };  // of the food
    b.at(-1.15, 1.05, 0);                                                 // at the food
    for (int i = 0; i < 14; ++i) b.update();
    CHECK(seen() == 0);
    for (int i = 0; i < 3; ++i) b.update();  // the step after 0.6 s
    CHECK(seen() > 0.98);
    b.at(1.15, -1.05, 0);  // far from it; the next view is taken after 1 s, and used 0.6 s later
    for (int i = 0; i < 20; ++i) b.update();
    CHECK(seen() > 0.98);
    for (int i = 0; i < 8; ++i) b.update();
    CHECK(seen() == 0);
}

TEST_CASE("Without the offset, the food lies at its object") {
    const auto seen_at_the_object = [](const char* offset) {
        AllostasisBench b;
        b.set("Field Offset", offset).start();
        b.at(-1.1, 1.1, 0);
        b.update();
        return b.outputs[2].segment(8, 4).mean();
    };
    CHECK(seen_at_the_object("false") > seen_at_the_object("true"));
}

TEST_CASE("moduleAllostasis reports times that are not possible") {
    AllostasisBench b;
    b.set("Cycle", "0");
    const auto all = b.problems();
    REQUIRE(all.size() == 1);
    CHECK_THAT(all[0].message, ContainsSubstring("'Cycle' is 0"));
}
