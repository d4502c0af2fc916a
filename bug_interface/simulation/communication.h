// Communication between robots: each transmits a message of 36 cells per cycle, and receives those of the
// others.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bug_interface/world/description.h"

namespace forage::bug {

inline constexpr std::size_t message_cells = 36;
using Message = std::array<double, message_cells>;

/// The transmitter and the receiver of one robot. Robots with the same communication key receive each other's
/// messages when they are more than `min_range` and less than `max_range` apart. Every cell is attenuated to
/// value * (1 - distance / max_range). A receiver keeps the last message of each sender until the next one
/// arrives, as in the original.
struct Transceiver {
    static constexpr double min_range = 0.1;                 ///< m
    static constexpr double max_range = 14.142135623730951;  ///< m: 10 sqrt(2)

    /// Transmits `cells` in this cycle from `sender_pose`. The message is silent when no cell is above 1e-5;
    /// a silent message is transmitted only when the one before it was not silent. Cells beyond message_cells
    /// are ignored, missing ones are 0.
    void transmit(std::string_view key, std::span<const double> cells, const Pose2& sender_pose);

    void checkpoint(Archive& archive) {
        archive(key, has_key, transmitting, audible, message, position, received);
    }

    std::string key;
    bool has_key = false;           ///< whether transmit() has been called
    bool transmitting = false;      ///< whether a message is sent in this cycle
    bool audible = false;           ///< whether the last message was not silent
    Message message{};              ///< the last message
    Pose2 position;                 ///< position of the robot when the message was transmitted
    std::vector<Message> received;  ///< the last message of each robot, attenuated
};

/// Delivers the messages of this cycle to the receivers at `positions`. `order` gives the order of the
/// senders.
void deliver(std::span<Transceiver*> transceivers, std::span<const Pose2> positions,
             std::span<const std::size_t> order);

/// The sum of the received messages over all senders, added in `order`.
Message sum_received(const Transceiver& receiver, std::span<const std::size_t> order);

}  // namespace forage::bug
