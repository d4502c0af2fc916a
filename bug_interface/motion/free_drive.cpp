#include "bug_interface/motion/free_drive.h"

#include <array>
#include <cmath>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

Pose2 free_drive(const Pose2& from, const MotorCommand& command, std::uint64_t steps, double step,
                 double noise, const RandomStream& random, std::uint64_t index) {
    const double n = static_cast<double>(steps), turn = command.turn * step, turned = n * turn;
    // The headings of the substeps are evenly spaced. Their sum has the direction of the middle heading
    // (Dirichlet kernel).
    const double middle = from.yaw + (n - 1) * turn / 2;
    const double lengths = std::abs(turn) < 1e-9 ? n : std::sin(turned / 2) / std::sin(turn / 2);
    double along = command.forward * step * lengths, across = 0, heading = from.yaw + turned;
    if (noise > 0) {
        std::array<double, 4> normal{};
        random.normal(index, normal);
        const double deviation = noise / std::sqrt(3.0);  // standard deviation of the uniform noise
        // The noise of the speed acts along the middle heading; because the headings vary, it acts across it,
        // too.
        const double spread = turned * turned / 12, speed = deviation * step * std::sqrt(n);
        along += speed * std::sqrt(1 - spread) * normal[0];
        across += speed * std::sqrt(spread) * normal[1];
        // The noise of the turn changes the heading by its sum. It shifts the robot sideways by a sum in
        // which each number has the weight of the substeps that follow.
        const double sum = deviation * std::sqrt(n) * normal[2];
        const double weighted = (n - 1) / 2 * sum + deviation * std::sqrt(n * (n * n - 1) / 12) * normal[3];
        heading += step * sum;
        across += command.forward * step * step * weighted;
    }
    const Eigen::Vector2d end = Transform2({from.x, from.y, middle}) * Eigen::Vector2d(along, across);
    return {end.x(), end.y(), heading};
}

}  // namespace forage::bug
