// The time within a run.
#pragma once

#include <cstdint>

namespace forage {

/// A time between two cycles.
struct SimTime {
    std::uint64_t cycle = 0;  ///< the number of the cycle to come, counted from 0
    double seconds = 0;       ///< since the start, of the world; without a world, at the system's own rate
    int trial = 0;            ///< the running trial, counted from 1; 0 in a run without trials
};

}  // namespace forage
