// Trials decide whether threads share a cycle. The test sets the clock.
#include "core/engine/parallel/parallel_tuner.h"

#include "tests/support/catch.h"

namespace {

using namespace forage;

struct TestClock {
    using duration = std::chrono::duration<double>;
    using time_point = std::chrono::time_point<TestClock, duration>;
    static inline duration passed{0};
    static time_point now() { return time_point(passed); }
};

/// Cycles with these durations without and with sharing, in units of `unit` seconds.
struct Machine {
    double without, with;
    double unit = 1e-4;
    engine::ParallelTuner<TestClock> trial;
    int shared = 0;    ///< of the cycles that were run last
    double spent = 0;  ///< by them

    void run(int cycles, bool worth = true) {
        shared = 0, spent = 0;
        for (int i = 0; i < cycles; ++i) {
            const bool now = trial.begin([&] { return worth; });
            shared += now;
            spent += now ? with : without;
            TestClock::passed += TestClock::duration(unit * (now ? with : without));
            trial.end();
        }
    }
};

constexpr int period = 4096;

TEST_CASE("Cycles that sharing makes faster are shared, except for a few cycles of each trial") {
    Machine m{.without = 1, .with = 0.55, .trial = {}};
    m.run(period);
    CHECK(m.shared >= period - 32);
    m.run(100 * period);
    CHECK(m.shared >= 100 * (period - 32));
}

TEST_CASE("Cycles that sharing does not clearly make faster stay on one thread") {
    Machine m{.without = 1, .with = 0.95, .trial = {}};
    m.run(10 * period);
    CHECK(m.shared <= 10 * 32);
}

TEST_CASE("However slow sharing is, a trial of it costs almost nothing") {
    for (const double with : {1.5, 20.0, 100.0}) {
        Machine m{.without = 1, .with = with, .trial = {}};
        m.run(10 * period);
        CHECK(m.shared >= 10);  // it was tried
        CHECK(m.spent < 1.04 * 10 * period);
    }
}

TEST_CASE("Sharing ends soon after it becomes slow, and resumes when it is fast again") {
    Machine m{.without = 1, .with = 0.55, .trial = {}};
    m.run(period / 2);
    m.with = 30;  // a processor is taken away
    m.run(period / 4);
    CHECK(m.shared < 64);
    m.with = 0.55;
    m.run(2 * period);
    CHECK(m.shared > period / 2);
}

TEST_CASE("Long cycles are tried more often, after 512 of them, unless a trial costs much") {
    Machine m{.without = 1, .with = 1.5, .unit = 0.004, .trial = {}};
    m.run(100);
    m.with = 0.55;
    m.run(600);
    CHECK(m.shared > 100);
    for (const double with : {3.0, 10.0, 30.0}) {
        Machine slow{.without = 1, .with = with, .unit = 0.004, .trial = {}};
        slow.run(10 * period);
        CHECK(slow.shared >= 10);
        CHECK(slow.spent < 1.04 * 10 * period);
    }
}

TEST_CASE("A thread that takes long to wake up does not end a trial") {
    Machine m{.without = 1, .with = 0.55, .trial = {}};
    m.run(16);
    m.with = 40;
    m.run(1);
    m.with = 0.55;
    m.run(period / 2);
    CHECK(m.shared > period / 4);
}

TEST_CASE("There is no trial when it cannot pay") {
    Machine m{.without = 1, .with = 0.55, .trial = {}};
    m.run(period, false);
    CHECK(m.shared == 0);
}

}  // namespace
