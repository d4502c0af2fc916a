#include "modules/allostasis/steering.h"

#include <algorithm>
#include <optional>

namespace forage::allostasis {
namespace {

constexpr double near = 0.29;      // m: an obstacle
constexpr double hold_time = 0.5;  // s

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// More of the field on the left minus more on the right; nothing in the dead sector.
std::optional<double> left_minus_right(double b, const Eigen::Array<double, 1, 4>& q, bool dead_sector) {
    if (b > 247 && b <= 292) return q[0] - q[1];
    if (b > 202 && b <= 247) return (q[0] + q[2]) / 2 - (q[0] + q[1]) / 2;
    if (b > 157 && b <= 202) return q[2] - q[0];
    if (b > 112 && b <= 157) return (q[2] + q[3]) / 2 - (q[2] + q[0]) / 2;
    if (b > 77 && b <= 112) return q[3] - q[2];
    if (b > 22 && b <= 77) return (q[3] + q[1]) / 2 - (q[3] + q[2]) / 2;
    if (b > 292 && b <= 337) return (q[1] + q[0]) / 2 - (q[1] + q[3]) / 2;
    if (dead_sector) return std::nullopt;
    return q[1] - q[3];
}

double cut(double x) { return std::clamp(x, -fastest_wheel, fastest_wheel); }

}  // namespace

Wheels Steering::step(double bearing, const LocalViews& views, const FiveNeeds& forces, double setpoint,
                      bool dead_sector, double u_right, double u_left) {
    double turn = 0;
    for (int i = 0; i < needs; ++i) {
        if (const auto difference = left_minus_right(bearing, views.row(i), dead_sector))
            sides_[i] = sign(*difference);
        const double mean = (views(i, 0) + views(i, 1) + views(i, 2) + views(i, 3)) / 4;
        directions_[i] = sign((i == security ? 0 : setpoint) - mean);
        turn += sides_[i] * directions_[i] * forces[i];
    }
    turn /= needs;
    return {std::min(fastest_wheel, (1 + turn) * (5 + u_right - 0.5)),
            std::min(fastest_wheel, (1 - turn) * (5 + u_left - 0.5))};
}

Wheels WheelControl::step(double time, const FrontRanges& r, const Wheels& wanted, const Wheels& z) {
    if (time >= last_ + hold_time) {
        last_ = time;
        if (std::min({r.ps0, r.ps1, r.ps6, r.ps7}) < near) {
            const bool room_on_the_right = (r.ps0 + r.ps1) / 2 > (r.ps6 + r.ps7) / 2;
            double& inner = room_on_the_right ? wheels_.right : wheels_.left;
            double& outer = room_on_the_right ? wheels_.left : wheels_.right;
            (inner > -6 ? inner : outer) -= 1;
        } else {
            wheels_ = wanted;
        }
    }
    wheels_ = {cut(wheels_.right + z.right), cut(wheels_.left + z.left)};
    return wheels_;
}

Wheels RandomWalk::step(const Eigen::Array<double, 8, 1>& ranges, const Wheels& z, const WalkSettings& s) {
    drew_ = false;
    if (++counter_ <= s.interval) return wheels_;
    if ((ranges < near).any()) {
        const bool room_on_the_right = ranges[0] + ranges[1] + ranges[2] > ranges[5] + ranges[6] + ranges[7];
        double& inner = room_on_the_right ? wheels_.right : wheels_.left;
        double& outer = room_on_the_right ? wheels_.left : wheels_.right;
        if (outer < s.fastest_turn) outer += 0.1;
        if (inner > 1) inner -= 0.1;
        return wheels_;
    }
    drew_ = true;
    counter_ = 0;
    wheels_ = {std::clamp(wheels_.right + z.right, s.lowest, s.highest),
               std::clamp(wheels_.left + z.left, s.lowest, s.highest)};
    return wheels_;
}

}  // namespace forage::allostasis
