// What robots say to each other.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bug_interface/world/description.h"

namespace forage::bug {

inline constexpr std::size_t sound_cells = 36;
using SoundCells = std::array<double, sound_cells>;

/// One robot's voice and ear. Who has the same communication key hears each other, from 0.1 m to 10 sqrt(2)
/// m: value * (1 - distance / 10 sqrt(2)). The last audible sound of a sender stays in the ear, as in the
/// original, until there is another one from it.
struct Voice {
    static constexpr double nearest = 0.1, farthest = 14.142135623730951;  ///< m

    /// Says `cells` in this cycle, at `place`. What is all below 1e-5 is said once, as silence, after a
    /// sound.
    void say(std::string_view key, std::span<const double> cells, const Pose2& place);

    void checkpoint(Archive& archive) { archive(key, tuned, speaking, sounding, said, place, heard); }

    std::string key;
    bool tuned = false;     ///< whether it has a key
    bool speaking = false;  ///< in this cycle
    bool sounding = false;  ///< whether what it said last was a sound
    SoundCells said{};
    Pose2 place;                    ///< where it spoke
    std::vector<SoundCells> heard;  ///< of each robot, as loud as it was
};

/// What is said in this cycle reaches who hears it at `places`. The senders are taken in the order of
/// `order`.
void deliver(std::span<Voice*> voices, std::span<const Pose2> places, std::span<const std::size_t> order);

/// The sum over all senders, in `order`.
SoundCells sum(const Voice& voice, std::span<const std::size_t> order);

}  // namespace forage::bug
