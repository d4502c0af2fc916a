#include "bug_interface/motion/free_drive.h"

#include <array>
#include <cmath>

namespace forage::bug {

Pose2 free_drive(const Pose2& from, const MotorCommand& command, std::uint64_t steps, double step,
                 double noise, const RandomStream& random, std::uint64_t index) {
    const double n = static_cast<double>(steps), turn = command.turn * step, turned = n * turn;
    // The substeps' headings are evenly spaced: their sum has the direction of the middle one (Dirichlet's
    // kernel).
    const double middle = from.yaw + (n - 1) * turn / 2;
    const double lengths = std::abs(turn) < 1e-9 ? n : std::sin(turned / 2) / std::sin(turn / 2);
    double along = command.forward * step * lengths, across = 0, heading = from.yaw + turned;
    if (noise > 0) {
        std::array<double, 4> normal{};
        random.normal(index, normal);
        const double deviation = noise / std::sqrt(3.0);  // of a uniform number
        // Speed: along the middle heading, but for the spread of the headings.
        const double spread = turned * turned / 12, speed = deviation * step * std::sqrt(n);
        along += speed * std::sqrt(1 - spread) * normal[0];
        across += speed * std::sqrt(spread) * normal[1];
        // Turn: a sum, and the same sum weighted with the substeps that follow.
        const double sum = deviation * std::sqrt(n) * normal[2];
        const double weighted = (n - 1) / 2 * sum + deviation * std::sqrt(n * (n * n - 1) / 12) * normal[3];
        heading += step * sum;
        across += command.forward * step * step * weighted;
    }
    const double c = std::cos(middle), s = std::sin(middle);
    return {from.x + along * c - across * s, from.y + along * s + across * c, heading};
}

}  // namespace forage::bug
