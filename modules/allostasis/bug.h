// The robot of the original arena on a Bug: its range sensors and its wheels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/column.h"
#include "core/types/module.h"
#include "modules/allostasis/steering.h"

namespace forage::allostasis {

/// The rays of the Bug's proximity sensor nearest to ps0 ... ps7, which look to -17, -49, -90, -150, 150, 90,
/// 49 and 17 degrees. Ray k looks to 3 - 6k/31 rad.
inline constexpr std::array<Index, 8> ray_of{17, 20, 23, 29, 2, 8, 11, 14};

/// The metres to the next surface, as the original's sensors give them, from a cell of the proximity group:
/// the Bug's sensor has a range of 2 m from its axis, and the Bug a radius of 0.2 m.
inline double range(double activity, double scale) {
    return std::min(0.3, (2 * (1 - activity) - 0.2) / scale);
}

/// Declares the output of the motor group that show_wheels() writes.
template <class T>
void describe_motor(ModuleSpec<T>& s) {
    s.output("motor", "Motor")
        .size("a square with an odd number of rows, at least 3",
              [](const auto&, PortSizes&, const GroupShape& given) {
                  const bool fits = given.width == given.height && given.width % 2 == 1 && given.width >= 3;
                  return fits ? given : rectangle(41, 41);
              })
        .doc(
            "1 at the wanted speed: the top row is 0.124 m/s times 'Scale' forwards, the left column "
            "a left turn with 4.77 rad/s.");
}

/// Writes 1 into the cell of a motor group of width x height cells that is nearest to the speeds of the
/// wheels.
inline void show_wheels(const Wheels& w, int width, int height, Column& motor) {
    const auto cell_at = [](double x, int n) {
        return static_cast<Index>(std::lround((std::clamp(x, -1.0, 1.0) + 1) / 2 * (n - 1)));
    };
    // Speeds as shares of the largest ones, which the motor group stands for.
    const double forward = (w.right + w.left) / (2 * fastest_wheel),
                 left = (w.right - w.left) / (2 * fastest_wheel);
    motor.setZero();
    motor[cell_at(-forward, height) * width + cell_at(-left, width)] = 1;
}

}  // namespace forage::allostasis
