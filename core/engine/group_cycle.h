// One group's part of a cycle, and what of it need not be done again.
//
// Much of a system stands still most of the time: displays of a layer that is closed, senses that see
// nothing, a constant. Three facts, each kept per group, let such parts cost nothing and change no bit:
//
// - changed: the last cycle whose activity differed from that of the cycle before.
// - same_input: what the next update reads is what the last one read; no source has changed, no module wrote.
// - rests: the last update left every state as it was and asked for neither time nor random numbers, so that
//   with the same input the next one would too.
//
// A group that rests and keeps its input is neither updated nor delivered to. Who changes something from
// outside (an activity, a parameter) must say so: touch().
#pragma once

#include <algorithm>
#include <cstring>

#include "core/engine/plan/plan.h"

namespace forage::engine {

/// A group's state in `cycle`.
inline double* state_row(const GroupPlan& g, std::size_t state, std::uint64_t cycle) {
    const auto& s = g.states[state];
    if (s.depth == 1) return s.ring;  // saves a division for every connection
    return s.ring + static_cast<Index>(cycle % static_cast<std::uint64_t>(s.depth)) * g.stride;
}

/// A group's activity in `cycle`.
inline double* activity_row(const GroupPlan& g, std::uint64_t cycle) {
    return state_row(g, static_cast<std::size_t>(g.output), cycle);
}

/// The cells of a part: whole grains of random numbers, and of lines of the cache.
inline Range cells_of_part(const GroupPlan& g, int part) {
    constexpr auto grain = RandomStream::grain;
    const auto cells = static_cast<std::size_t>(g.cells);
    Range out((cells + grain - 1) / grain, part, static_cast<int>(g.parts.size()));
    out.first *= grain;
    out.last = std::min(out.last * grain, cells);
    return out;
}

/// Bit by bit.
inline bool same_bits(const double* a, const double* b, Index n) {
    return std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof *a) == 0;
}

/// The group was changed from outside: nothing that is known of it holds any longer.
inline void touch(GroupPlan& g, std::uint64_t cycle) {
    g.rests = g.silent = false;
    g.same_for = 0;
    g.changed = static_cast<std::int64_t>(cycle);
}

}  // namespace forage::engine
