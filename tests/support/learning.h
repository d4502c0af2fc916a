// The complete DAC system learning in an arena, and how often it succeeds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/closed_loop.h"

namespace forage::test {

inline constexpr std::uint64_t learning_seeds[] = {1, 2, 3, 4, 5};

struct DacLoop : ClosedLoop {
    DacLoop(const std::string& arena, std::uint64_t seed, std::vector<std::string> set = {})
        : ClosedLoop({.system = "dac_foraging.iqr",
                      .world = "worlds/" + arena + ".world",
                      .seed = seed,
                      .set = std::move(set)}) {}

    /// Part of the last `count` trials that reached the target.
    double success(std::size_t count) const {
        const auto& all = world->trials(0);
        const auto reached = std::count_if(all.end() - static_cast<std::ptrdiff_t>(count), all.end(),
                                           [](const auto& t) { return t.target(); });
        return static_cast<double>(reached) / static_cast<double>(count);
    }
};

}  // namespace forage::test
