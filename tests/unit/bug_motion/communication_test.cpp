// How far robots are heard, and for how long.
#include "bug_interface/simulation/voice.h"

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/catch.h"

using namespace forage::bug;

namespace {

/// A speaker at the origin and an ear with the same key.
struct Two {
    std::array<Voice, 2> voices;
    std::vector<std::size_t> order{0, 1};

    Two() {
        for (Voice& v : voices) v.heard.resize(2);
    }
    /// What the ear gets when the first cell is said with `level` and the ear is `distance` metres away.
    double heard(double level, double distance) {
        const std::vector<double> cells{level}, silence(36, 0);
        voices[0].say("key", cells, {0, 0, 0});
        voices[1].say("key", silence, {distance, 0, 0});
        std::array<Voice*, 2> all{&voices[0], &voices[1]};
        const std::array<Pose2, 2> places{Pose2{0, 0, 0}, {distance, 0, 0}};
        deliver(all, places, order);
        return sum(voices[1], order)[0];
    }
};

const double reach = 10 * std::sqrt(2.0);

}  // namespace

TEST_CASE("A voice is heard from 0.1 to 14.14 m, in proportion to what is left of the way") {
    for (const double d : {0.11, 1.0, 7.0, 10.0, 14.0, 14.142}) {
        INFO(d);
        CHECK(Two().heard(0.6, d) == Approx(0.6 * (reach - d) / reach));
    }
    for (const double d : {0.0, 0.05, 0.0999, 14.1422, 20.0}) CHECK(Two().heard(0.6, d) == 0);
}

TEST_CASE("The last sound that was heard of a robot stays when it has gone out of reach") {
    Two two;
    const double near = two.heard(0.6, 2);
    CHECK(two.heard(0.9, 15) == near);
    CHECK(two.heard(0, 15) == near);  // its silence is not heard either
    CHECK(two.heard(0, 2) == near);   // and is said once only
    CHECK(two.heard(0.3, 2) == Approx(near / 2));
    CHECK(two.heard(0, 2) == 0);
}

TEST_CASE("What is below 1e-5 is no sound") {
    Two two;
    CHECK(two.heard(1e-5, 2) == 0);
    CHECK(two.heard(1.1e-5, 2) > 0);
}
