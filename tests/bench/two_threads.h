// How much faster is a simulation on two threads, and how much faster are two simulations side by side?
//
// Processors of a virtual machine are often halves of one core, or shared with other guests. Two threads that
// share nothing then gain less than a factor of two, too. Their gain is measured in the same turns for
// comparison. As they need twice the cache, sharing may gain more.
#pragma once

#include <algorithm>
#include <thread>

#include "core/engine/simulation.h"
#include "tests/bench/report.h"

namespace forage::bench {

/// The gain of two threads.
struct Gain {
    double shared;  ///< of a simulation that shares each cycle: ratio of the best blocks
    double usual;   ///< ratio of the medians, which include trials and wake-ups
    double apart;   ///< of two simulations that share nothing: ratio of the best blocks
};

/// Measures blocks of `cycles` cycles. `one` and `other` are equal simulations on one thread each; `two` is
/// the same on two threads.
inline Gain gain_of_two_threads(engine::Simulation& one, engine::Simulation& other, engine::Simulation& two,
                                int cycles = 1) {
    const auto steps = [](engine::Simulation& s, int n) {
        for (int i = 0; i < n; ++i) s.step();
    };
    const double seconds = 1 / rates(wall_seconds, [&] { steps(one, cycles); }).best();
    const int several = cycles * std::max(1, static_cast<int>(0.01 / seconds));  // a thread costs some 50 us
    const auto [alone, shared, beside] = rates_in_turns(
        wall_seconds, [&] { steps(one, cycles); }, [&] { steps(two, cycles); },
        [&] {
            std::thread thread([&] { steps(other, several); });
            steps(one, several);
            thread.join();
        });
    return {shared.best() / alone.best(), shared.median() / alone.median(),
            2 * several / cycles * beside.best() / alone.best()};
}

}  // namespace forage::bench
