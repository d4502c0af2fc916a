#include "bug_interface/sensing/range_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace forage::bug {
namespace {

/// Reduces `range` to the measurement of a ray that is inside a solid from `enter` to `leave`, all distances
/// from the sensor in m.
void keep_nearest(double enter, double leave, double min, double& range) {
    const double hit = enter >= min ? enter : leave;  // a ray that starts inside measures the far side
    if (leave >= min && hit < range) range = hit;
}

}  // namespace

RangeScanner::RangeScanner(const RangeSensor& sensor, const Pose& link_pose)
    : min_(sensor.min_range), max_(sensor.max_range), noise_(sensor.noise) {
    const Pose pose = link_pose * sensor.pose;
    mount_ = in_plane(pose);
    height_ = pose.translation().z();
    for (int i = 0; i < sensor.rays; ++i) {
        const double step =
            sensor.rays > 1 ? (sensor.last_angle - sensor.first_angle) / (sensor.rays - 1) : 0;
        const double angle = mount_.yaw + sensor.first_angle + i * step;
        direction_x_.push_back(std::cos(angle)), direction_y_.push_back(std::sin(angle));
    }
}

void RangeScanner::scan(const Pose2& robot, std::span<const Outline> outlines,
                        std::span<double> ranges) const {
    std::fill(ranges.begin(), ranges.end(), max_);
    const double c = std::cos(robot.yaw), s = std::sin(robot.yaw);
    const Eigen::Vector2d sensor = Transform2(robot.x, robot.y, c, s) * Eigen::Vector2d(mount_.x, mount_.y);
    for (const Outline& o : outlines) {
        const double dx = o.x - sensor.x(), dy = o.y - sensor.y();
        const double reach = max_ + bounding_radius(o);
        if (dx * dx + dy * dy > reach * reach) continue;
        // The outline relative to the sensor, in the orientation of the robot, in which the rays are
        // constant.
        const double forward = c * dx + s * dy, left = c * dy - s * dx;
        if (o.round)
            scan_circle(forward, left, o.radius, ranges);
        else
            scan_box(forward, left, c * o.cos_yaw + s * o.sin_yaw, c * o.sin_yaw - s * o.cos_yaw, o.half_x,
                     o.half_y, ranges);
    }
}

void RangeScanner::scan_circle(double x, double y, double radius, std::span<double> ranges) const {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const double along = direction_x_[i] * x + direction_y_[i] * y;
        const double aside = direction_x_[i] * y - direction_y_[i] * x;
        const double square = radius * radius - aside * aside;
        if (square < 0) continue;
        const double half = std::sqrt(square);
        keep_nearest(along - half, along + half, min_, ranges[i]);
    }
}

void RangeScanner::scan_box(double x, double y, double cos_yaw, double sin_yaw, double half_x, double half_y,
                            std::span<double> ranges) const {
    const double origin[2] = {-(cos_yaw * x + sin_yaw * y),
                              sin_yaw * x - cos_yaw * y};  // direction of the ray in the frame of the box
    const double half[2] = {half_x, half_y};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const double direction[2] = {cos_yaw * direction_x_[i] + sin_yaw * direction_y_[i],
                                     cos_yaw * direction_y_[i] - sin_yaw * direction_x_[i]};
        double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
        for (int axis = 0; axis < 2; ++axis) {
            if (std::abs(direction[axis]) < 1e-12) {  // parallel to two sides: always or never between them
                if (std::abs(origin[axis]) > half[axis]) leave = -std::numeric_limits<double>::infinity();
                continue;
            }
            const double centre = -origin[axis] / direction[axis],
                         reach = half[axis] / std::abs(direction[axis]);
            enter = std::max(enter, centre - reach);
            leave = std::min(leave, centre + reach);
        }
        if (enter <= leave) keep_nearest(enter, leave, min_, ranges[i]);
    }
}

void RangeScanner::add_noise(std::span<double> ranges, const RandomStream& random,
                             std::uint64_t sample) const {
    if (noise_ <= 0) return;
    std::array<double, 64> normal;
    const std::size_t blocks = (ranges.size() + normal.size() - 1) / normal.size();
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t first = b * normal.size();
        const auto block = ranges.subspan(first, std::min(normal.size(), ranges.size() - first));
        random.normal(sample * blocks + b, std::span(normal).first(block.size()));
        for (std::size_t i = 0; i < block.size(); ++i)
            block[i] = std::clamp(block[i] + noise_ * normal[i], min_, max_);
    }
}

void RangeScanner::to_activity(std::span<const double> ranges, std::span<double> cells) const {
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = (max_ - ranges[ranges.size() - 1 - k]) / max_;
}

}  // namespace forage::bug
