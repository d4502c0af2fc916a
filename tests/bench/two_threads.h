// How much faster is a simulation on two threads, and how much faster can it be?
//
// Processors of a virtual machine are often halves of one core, or shared with neighbours: two threads that
// have nothing to do with each other then gain less than twice, too. What they gain is measured in the same
// turns.
#pragma once

#include <algorithm>
#include <thread>

#include "core/engine/simulation.h"
#include "tests/bench/report.h"

namespace forage::bench {

/// What two threads gain, and what they could.
struct Gain {
    Rates alone;      ///< on one thread
    double shared;    ///< times as fast, when two threads share each cycle
    double possible;  ///< times as many cycles, of two simulations that run side by side and share nothing
};

/// `cycles` belong together. `one`, `other`: alike, on one thread each; `two`: on two.
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
    return {alone, shared.best() / alone.best(), 2 * several / cycles * beside.best() / alone.best()};
}

}  // namespace forage::bench
