#include "bug_interface/sensing/range_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/simd.h"

namespace forage::bug {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Returns the smaller one of `range` and the measurement of a ray that is inside a solid from `enter` to
/// `leave`, all distances from the sensor in m. A ray that starts inside measures the far side.
[[gnu::always_inline]] inline double nearest(double enter, double leave, double min, double range) {
    const double hit = enter >= min ? enter : leave;
    const bool nearer = enter <= leave && leave >= min && hit < range;
    return nearer ? hit : range;
}

/// The constants of one rectangle for all rays.
struct BoxInView {
    double cos_yaw, sin_yaw, origin_x, origin_y, half_x, half_y;
};

FORAGE_SIMD void meet_rectangle(const BoxInView box, double min, const double* __restrict direction_x,
                                const double* __restrict direction_y, std::size_t rays,
                                double* __restrict ranges) {
    for (std::size_t i = 0; i < rays; ++i) {
        double enter = -nowhere, leave = nowhere;
        const auto slab = [&](double direction, double origin, double half) {
            const bool along = std::abs(direction) < 1e-12;  // always or never between the two sides
            const double across = along ? 1.0 : direction;
            const double centre = -origin / across, reach = half / std::abs(across);
            const double nearer = along ? -nowhere : centre - reach;
            const double farther = along ? (std::abs(origin) > half ? -nowhere : nowhere) : centre + reach;
            enter = enter < nearer ? nearer : enter;
            leave = farther < leave ? farther : leave;
        };
        slab(box.cos_yaw * direction_x[i] + box.sin_yaw * direction_y[i], box.origin_x, box.half_x);
        slab(box.cos_yaw * direction_y[i] - box.sin_yaw * direction_x[i], box.origin_y, box.half_y);
        ranges[i] = nearest(enter, leave, min, ranges[i]);
    }
}

FORAGE_SIMD void meet_circle(double x, double y, double radius, double min,
                             const double* __restrict direction_x, const double* __restrict direction_y,
                             std::size_t rays, double* __restrict ranges) {
    for (std::size_t i = 0; i < rays; ++i) {
        const double along = direction_x[i] * x + direction_y[i] * y;
        const double aside = direction_x[i] * y - direction_y[i] * x;
        const double square = radius * radius - aside * aside;
        const double half = std::sqrt(square < 0 ? 0.0 : square);
        ranges[i] = nearest(square < 0 ? nowhere : along - half, along + half, min, ranges[i]);
    }
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
        if (o.round) {
            meet_circle(forward, left, o.radius, min_, direction_x_.data(), direction_y_.data(),
                        ranges.size(), ranges.data());
            continue;
        }
        const double cos_yaw = c * o.cos_yaw + s * o.sin_yaw, sin_yaw = c * o.sin_yaw - s * o.cos_yaw;
        meet_rectangle({cos_yaw, sin_yaw, -(cos_yaw * forward + sin_yaw * left),
                        sin_yaw * forward - cos_yaw * left, o.half_x, o.half_y},
                       min_, direction_x_.data(), direction_y_.data(), ranges.size(), ranges.data());
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
