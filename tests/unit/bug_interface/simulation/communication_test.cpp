// The range, the attenuation and the memory of the communication between robots.
#include "bug_interface/simulation/communication.h"

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/catch.h"

using namespace forage::bug;

namespace {

/// A sender at the origin and a receiver with the same key.
struct Pair {
    std::array<Transceiver, 2> transceivers;
    std::vector<std::size_t> order{0, 1};

    Pair() {
        for (Transceiver& t : transceivers) t.received.resize(2);
    }
    /// The first cell that is received at `distance` (m) when the sender transmits `level` in it.
    double received(double level, double distance) {
        const std::vector<double> cells{level}, silence(36, 0);
        transceivers[0].transmit("key", cells, {0, 0, 0});
        transceivers[1].transmit("key", silence, {distance, 0, 0});
        std::array<Transceiver*, 2> all{&transceivers[0], &transceivers[1]};
        const std::array<Pose2, 2> positions{Pose2{0, 0, 0}, {distance, 0, 0}};
        deliver(all, positions, order);
        return sum_received(transceivers[1], order)[0];
    }
};

const double communication_range = 10 * std::sqrt(2.0);

}  // namespace

TEST_CASE("A message is received from 0.1 to 14.14 m, with linear attenuation") {
    for (const double d : {0.11, 1.0, 7.0, 10.0, 14.0, 14.142}) {
        INFO(d);
        CHECK(Pair().received(0.6, d) == Approx(0.6 * (communication_range - d) / communication_range));
    }
    for (const double d : {0.0, 0.05, 0.0999, 14.1422, 20.0}) CHECK(Pair().received(0.6, d) == 0);
}

TEST_CASE("The last message of a robot stays when the robot has left the range") {
    Pair pair;
    const double near = pair.received(0.6, 2);
    CHECK(pair.received(0.9, 15) == near);
    CHECK(pair.received(0, 15) == near);  // a silent message is not received out of range
    CHECK(pair.received(0, 2) == near);   // and is transmitted only once
    CHECK(pair.received(0.3, 2) == Approx(near / 2));
    CHECK(pair.received(0, 2) == 0);
}

TEST_CASE("A message of cells below 1e-5 is silent") {
    Pair pair;
    CHECK(pair.received(1e-5, 2) == 0);
    CHECK(pair.received(1.1e-5, 2) > 0);
}
