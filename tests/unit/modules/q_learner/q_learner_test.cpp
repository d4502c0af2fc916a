#include "modules/q_learner/q_learner.h"

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using q_learner::QLearnerModule;

namespace {

int proposed(const Eigen::ArrayXd& cells) {
    Index cell = 0;
    return cells.maxCoeff(&cell) > 0 ? static_cast<int>(cell) : -1;
}

struct Learner : ModuleBench {
    Learner() : ModuleBench(module_type<QLearnerModule>()) {
        set("Decision Interval", "1").set("Exploration", "0");
        in("state", 3, 1).in("action", 2, 1).in("reward", 2, 1);
        out("action", 2, 1).out("Q", 2, 1).out("states", 1, 1);
    }
    void cycle(int state, int action, double reward = 0, bool ends = false) {
        inputs[0].setZero(), inputs[1].setZero();
        inputs[0][state] = 1;
        if (action >= 0) inputs[1][action] = 1;
        inputs[2] << reward, ends;
        update();
    }
};

}  // namespace

TEST_CASE("moduleQLearner learns the way to a reward backwards, and proposes only what has a value") {
    Learner b;
    REQUIRE(b.problems().empty());
    b.set("Learning Rate", "1").set("Discount", "0.5").set("Time Penalty", "0");
    b.start();
    const auto episode = [&] {
        b.cycle(0, -1);
        const int first = proposed(b.outputs[0]);
        b.cycle(1, 1);
        const int second = proposed(b.outputs[0]);
        b.cycle(2, 0, 1, true);
        b.cycle(2, 0, 0, true);
        return std::pair{first, second};
    };
    CHECK(episode() == std::pair{-1, -1});
    CHECK(episode() == std::pair{-1, 0});  // the last step is known
    CHECK(episode() == std::pair{1, 0});
    b.cycle(0, -1);
    CHECK(b.outputs[1][1] == Approx(0.5));
    CHECK(b.outputs[2][0] == 2);  // state 2 was seen at ends only
}

TEST_CASE("moduleQLearner leaves a share of the decisions to others") {
    Learner b;
    b.set("Learning Rate", "1").set("Exploration", "0.25").seed(2).start();
    b.cycle(0, -1);
    b.cycle(0, 1, 1, true);
    int silent = 0;
    for (int i = 0; i < 400; ++i) {
        b.cycle(0, -1);
        silent += proposed(b.outputs[0]) < 0;
    }
    CHECK(silent / 400.0 == Approx(0.25).margin(0.06));
}

TEST_CASE("A moduleQLearner that is written and read back continues with the same bits") {
    const auto drive = [](Learner& b, int from, int to) {
        std::vector<double> seen;
        for (int t = from; t < to; ++t) {
            b.cycle(t * 7 % 3, t * 5 % 2, t % 9 == 8, t % 9 == 8);
            for (const auto& values : b.outputs)
                for (const double v : values) seen.push_back(v);
        }
        return seen;
    };
    Learner one, two;
    one.set("Exploration", "0.3").seed(3).start();
    two.set("Exploration", "0.3").seed(3).start();
    drive(one, 0, 50);
    for (int t = 0; t < 50; ++t) two.cycle(0, -1);
    Archive out;
    one.module<QLearnerModule>().checkpoint(out);
    Archive in(out.bytes());
    two.module<QLearnerModule>().checkpoint(in);
    CHECK(in.left().empty());
    two.outputs = one.outputs;
    CHECK(drive(one, 50, 150) == drive(two, 50, 150));
}
