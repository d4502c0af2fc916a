#include "bug_interface/simulation/communication.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

constexpr double silence = 1e-5;

}  // namespace

void Transceiver::transmit(std::string_view new_key, std::span<const double> cells,
                           const Pose2& sender_pose) {
    if (key != new_key) key = new_key;
    has_key = true, position = sender_pose;
    const bool was_audible = audible;
    audible = std::ranges::any_of(cells, [](double v) { return v > silence; });
    transmitting = audible || was_audible;
    message.fill(0);
    if (audible) std::copy_n(cells.begin(), std::min(cells.size(), message.size()), message.begin());
}

void deliver(std::span<Transceiver*> transceivers, std::span<const Pose2> positions,
             std::span<const std::size_t> order) {
    for (const std::size_t from : order) {
        Transceiver& sender = *transceivers[from];
        if (!sender.transmitting) continue;
        sender.transmitting = false;
        for (std::size_t to = 0; to < transceivers.size(); ++to) {
            Transceiver& receiver = *transceivers[to];
            if (to == from || !receiver.has_key || receiver.key != sender.key) continue;
            const double distance =
                std::hypot(positions[to].x - sender.position.x, positions[to].y - sender.position.y);
            if (!(distance > Transceiver::min_range && distance < Transceiver::max_range)) continue;
            for (std::size_t c = 0; c < message_cells; ++c)
                receiver.received[from][c] =
                    sender.message[c] * (Transceiver::max_range - distance) / Transceiver::max_range;
        }
    }
}

Message sum_received(const Transceiver& receiver, std::span<const std::size_t> order) {
    Message sum{};
    for (const std::size_t from : order)
        for (std::size_t c = 0; c < message_cells; ++c) sum[c] += receiver.received[from][c];
    return sum;
}

}  // namespace forage::bug
