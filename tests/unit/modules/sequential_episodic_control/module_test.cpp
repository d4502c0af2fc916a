// moduleSEC: decisions, gates, pictures, checkpoints, and a task in which the way to a state matters.
#include "modules/sequential_episodic_control/module.h"

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using sec::SequentialControlModule;

namespace {

const std::vector<std::string> pictures{"memory", "eligibility", "trigger", "selected", "rewards"};

struct SequentialBench : ModuleBench {
    SequentialBench(int segments, int capacity) : ModuleBench(module_type<SequentialControlModule>()) {
        set("Sequence Length", std::to_string(segments)).set("Memory Capacity", std::to_string(capacity));
        set("Decision Interval", "1").set("Least Sequences", "0");
        in("state", 4, 1).in("action", 3, 1).in("reward", 2, 1).in("discrepancy", 1, 1);
        out("action", 3, 1).out("Q", 3, 1).out("policy", 3, 1).out("entropy", 1, 1);
        for (const auto& p : pictures) out(p, p == "rewards" ? 1 : segments, capacity);
    }
    /// One cycle: the state is one of four cells (none: -1), the action one of three (none: -1).
    void cycle(int state, int action, double reward = 0, bool ends = false) {
        inputs[0].setZero(), inputs[1].setZero();
        if (state >= 0) inputs[0][state] = 1;
        if (action >= 0) inputs[1][action] = 1;
        inputs[2] << reward, ends;
        update();
    }
    int chosen() const {
        Index cell = 0;
        return outputs[0].maxCoeff(&cell) > 0 ? static_cast<int>(cell) : -1;
    }
};

/// Stores the way 0 -> 1 with the actions 1 and 2.
void learn(SequentialBench& b) {
    b.cycle(0, -1);
    b.cycle(1, 1);
    b.cycle(2, 2);
    b.cycle(2, 0, 1, true);
}

/// A corridor with a cue (state 0 or 1) and a junction (state 2) at which action 0 is right after cue 0, and
/// action 1 after cue 1. An agent explores until the module has a proposal. Returns the reward of 200 trials.
double corridor(bool bias, std::uint64_t seed) {
    ModuleBench b(module_type<SequentialControlModule>());
    b.set("Sequence Length", "2").set("Memory Capacity", "100").set("Decision Interval", "1");
    b.set("Sequential Bias", bias ? "true" : "false");
    b.set("Least Sequences", "20");  // with few, all may be of one cue, and the other way is never tried
    b.in("state", 4, 1).in("action", 3, 1).in("reward", 2, 1).bind("discrepancy", false, 0, 0, 0);
    b.out("action", 3, 1);
    for (const auto& p : {"Q", "policy", "entropy"}) b.bind(p, true, 0, 0, 0);
    for (const auto& p : pictures) b.bind(p, true, 0, 0, 0);
    b.seed(seed).start();
    const RandomStream random(seed, "corridor");
    double total = 0;
    const auto cycle = [&](int state, int action, double reward, bool ends) {
        b.inputs[0].setZero(), b.inputs[1].setZero();
        b.inputs[0][state] = 1;
        if (action >= 0) b.inputs[1][action] = 1;
        b.inputs[2] << reward, ends;
        b.update();
    };
    for (std::uint32_t trial = 0; trial < 200; ++trial) {
        const int cue = random.uniform(trial, 0) < 0.5 ? 0 : 1;
        cycle(cue, -1, 0, false);
        cycle(2, 2, 0, false);  // action 2: straight on to the junction
        Index proposed = 0;
        const bool proposes = b.outputs[0].head(2).maxCoeff(&proposed) > 0;
        const int action = proposes ? static_cast<int>(proposed) : random.uniform(trial, 1) < 0.5 ? 0 : 1;
        cycle(3, action, 0, false);
        const bool right = action == cue;
        total += right;
        cycle(3, -1, right ? 1 : 0, true);
        cycle(3, -1, 0, false);
    }
    return total;
}

}  // namespace

TEST_CASE("moduleSEC repeats the way that led to a reward, and prefers what comes next") {
    SequentialBench b(3, 5);
    REQUIRE(b.problems().empty());
    b.start();
    learn(b);
    b.cycle(0, -1);
    CHECK(b.chosen() == 1);
    CHECK(b.outputs[2][1] == Approx(1));  // the policy
    CHECK(b.outputs[3][0] == Approx(0).margin(1e-12));
    CHECK(b.outputs[4].sum() == 3);  // one sequence of three segments
    CHECK(b.outputs[7].sum() == 1);  // one of them selected
    CHECK(b.outputs[8][0] > 0.9);    // its reward, with the penalties of four cycles
    CHECK(b.outputs[8][0] == Approx(1 - 4 * 0.001));
    b.cycle(1, 1);
    CHECK(b.chosen() == 2);
    CHECK(b.outputs[6].maxCoeff() == Approx(1.01));  // the trigger of the segment after the selected one
    b.cycle(3, 2);
    CHECK(b.chosen() == -1);
}

TEST_CASE("moduleSEC acts only with enough sequences and a small discrepancy; a lasting reward counts once") {
    SequentialBench b(3, 5);
    b.start();
    learn(b);
    b.cycle(2, 0, 1, true);
    b.cycle(2, 0, 1, true);
    CHECK(b.module<SequentialControlModule>().memory().sequences().size() == 1);
    b.inputs[3][0] = 0.5;
    b.cycle(0, -1);
    CHECK(b.chosen() == -1);
    b.inputs[3][0] = 0;
    b.cycle(0, -1);
    CHECK(b.chosen() == 1);
    b.set("Least Sequences", "1");
    b.cycle(0, -1);
    CHECK(b.chosen() == -1);
    b.set("Least Sequences", "0").set("Ignore Silence", "true");
    b.cycle(0, -1);
    CHECK(b.chosen() == 1);
    b.cycle(-1, -1);
    CHECK(b.chosen() == -1);
}

TEST_CASE("moduleSEC decides in every k-th cycle of an episode and keeps its outputs between") {
    SequentialBench b(3, 5);
    b.start();
    learn(b);
    b.set("Decision Interval", "3");
    b.cycle(0, -1);
    CHECK(b.chosen() == 1);
    b.cycle(1, -1);
    CHECK(b.chosen() == 1);
    b.cycle(1, -1);
    CHECK(b.chosen() == 1);
    b.cycle(1, 1);
    CHECK(b.chosen() == 2);
}

TEST_CASE("A moduleSEC that is written and read back continues with the same bits") {
    const auto drive = [](SequentialBench& b, int from, int to) {
        std::vector<double> seen;
        for (int t = from; t < to; ++t) {
            b.cycle(t * 7 % 4, t * 5 % 3, t % 9 == 8, t % 9 == 8);
            for (const auto& values : b.outputs)
                for (const double v : values) seen.push_back(v);
        }
        return seen;
    };
    SequentialBench one(3, 4), two(3, 4);
    one.seed(3).start();
    two.seed(3).start();
    drive(one, 0, 100);
    drive(two, 0, 100);
    Archive out;
    one.module<SequentialControlModule>().checkpoint(out);
    SequentialBench third(3, 4);
    third.seed(3).start();
    for (int t = 0; t < 100; ++t) third.cycle(-1, -1);  // to the same cycle, with another past
    Archive in(out.bytes());
    third.module<SequentialControlModule>().checkpoint(in);
    CHECK(in.left().empty());
    third.outputs = one.outputs;
    const auto expected = drive(two, 100, 200);
    CHECK(drive(third, 100, 200) == expected);
}

TEST_CASE("Between episodes moduleSEC neither decides nor counts time, and keeps the last couplet") {
    SequentialBench b(3, 5);
    b.start();
    b.cycle(0, -1);
    b.cycle(1, 1);
    b.cycle(2, 2, 1, true);
    for (int i = 0; i < 10; ++i) {
        b.cycle(3, 2, 0, true);  // the reset lasts
        CHECK(b.chosen() == -1);
    }
    b.cycle(0, 0);
    b.cycle(1, 1);
    b.cycle(2, 2, 1, true);
    const auto& all = b.module<SequentialControlModule>().memory().sequences();
    REQUIRE(all.size() == 2);
    CHECK(all[0].reward == Approx(1 - 3 * 0.001));
    CHECK(all[1].reward == Approx(1 - 3 * 0.001));
    CHECK(all[1].actions[0] == 2);  // with which the first episode ended
}

TEST_CASE("moduleSEC reports options and sizes that it does not know") {
    SequentialBench b(3, 4);
    b.set("Forgetting", "LRU").set("Choice", "best").set("Decision Interval", "0");
    const auto all = b.problems();
    REQUIRE(all.size() == 3);
    CHECK_THAT(all[0].message, ContainsSubstring("'Decision Interval' is 0"));
    CHECK_THAT(all[1].message, ContainsSubstring("'Choice' cannot be 'best'"));
    CHECK_THAT(all[2].hint, ContainsSubstring("use one of: NONE, FIFO, RWD"));
}

TEST_CASE("Where the way decides what a state calls for, the sequential bias pays") {
    // Chance is 100 of 200 trials. Every agent with the bias beats every agent without it.
    double least = 200, most = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        least = std::min(least, corridor(true, seed));
        most = std::max(most, corridor(false, seed));
    }
    INFO("with the bias at least " << least << ", without at most " << most);
    CHECK(least > 165);
    CHECK(most < 130);
}
