#include "bug_interface/simulation/voice.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

constexpr double silence = 1e-5;

}  // namespace

void Voice::say(std::string_view with, std::span<const double> cells, const Pose2& where) {
    if (key != with) key = with;
    tuned = true, place = where;
    const bool sound = std::any_of(cells.begin(), cells.end(), [](double v) { return v > silence; });
    speaking = sound || sounding;
    sounding = sound;
    said.fill(0);
    if (sound) std::copy_n(cells.begin(), std::min(cells.size(), said.size()), said.begin());
}

void deliver(std::span<Voice*> voices, std::span<const Pose2> places, std::span<const std::size_t> order) {
    for (const std::size_t from : order) {
        Voice& sender = *voices[from];
        if (!sender.speaking) continue;
        sender.speaking = false;
        for (std::size_t to = 0; to < voices.size(); ++to) {
            Voice& ear = *voices[to];
            if (to == from || !ear.tuned || ear.key != sender.key) continue;
            const double distance = std::hypot(places[to].x - sender.place.x, places[to].y - sender.place.y);
            if (!(distance > Voice::nearest && distance < Voice::farthest)) continue;
            for (std::size_t c = 0; c < sound_cells; ++c)
                ear.heard[from][c] = sender.said[c] * (Voice::farthest - distance) / Voice::farthest;
        }
    }
}

SoundCells sum(const Voice& voice, std::span<const std::size_t> order) {
    SoundCells out{};
    for (const std::size_t from : order)
        for (std::size_t c = 0; c < sound_cells; ++c) out[c] += voice.heard[from][c];
    return out;
}

}  // namespace forage::bug
