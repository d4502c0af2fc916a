#include "bug_interface/motion/motor.h"

#include <limits>

namespace forage::bug {

std::optional<std::size_t> motor_winner(std::span<const double> activities) {
    float highest = -std::numeric_limits<float>::infinity(), lowest = std::numeric_limits<float>::infinity();
    std::size_t winner = 0;
    for (std::size_t i = 0; i < activities.size(); ++i) {  // compared in double, stored in single precision
        if (activities[i] > static_cast<double>(highest))
            highest = static_cast<float>(activities[i]), winner = i;
        if (activities[i] < static_cast<double>(lowest)) lowest = static_cast<float>(activities[i]);
    }
    if (!(highest > 0) || highest == lowest) return std::nullopt;
    return winner;
}

MotorCommand decode_motor(std::span<const double> activities, int width, int height, double forward_speed,
                          double turn_speed) {
    if (width < 2 || height < 2) return {};
    const auto winner = motor_winner(activities);
    if (!winner) return {};
    const int row = static_cast<int>(*winner) / width, column = static_cast<int>(*winner) % width;
    const int half_width = width / 2, half_height = height / 2;  // swapped below, as in the original
    return {(half_width - row) / static_cast<double>(half_width) * forward_speed,
            (half_height - column) / static_cast<double>(half_height) * turn_speed};
}

std::string in_words(const MotorCommand& command) {
    const std::string side = command.turn > 0 ? "left" : "right";
    if (command.forward == 0) return command.turn == 0 ? "stand still" : "turn " + side + " on the spot";
    const std::string way = command.forward > 0 ? "ahead" : "back";
    return command.turn == 0 ? "straight " + way : way + " in a " + side + " turn";
}

}  // namespace forage::bug
