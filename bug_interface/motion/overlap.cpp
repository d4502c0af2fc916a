#include "bug_interface/motion/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forage::bug {
namespace {

using Eigen::Vector2d;

Vector2d centre(const Outline& o) { return {o.x, o.y}; }

Overlap circles(const Outline& a, const Outline& b) {
    const Vector2d between = centre(b) - centre(a);
    const double distance = between.norm();
    return {a.radius + b.radius - distance, distance > 0 ? Vector2d(between / distance) : Vector2d(1, 0)};
}

Overlap box_circle(const Outline& box, const Outline& circle) {
    const Vector2d between = centre(circle) - centre(box);
    const Vector2d along(box.cos_yaw, box.sin_yaw), across(-box.sin_yaw, box.cos_yaw);
    const double u = between.dot(along), v = between.dot(across);
    const double out_u = std::abs(u) - box.half_x, out_v = std::abs(v) - box.half_y;
    const Vector2d to_u = std::copysign(1.0, u) * along, to_v = std::copysign(1.0, v) * across;
    if (out_u <= 0 && out_v <= 0)  // the centre is inside: the nearest side is the shortest way out
        return out_u > out_v ? Overlap{circle.radius - out_u, to_u} : Overlap{circle.radius - out_v, to_v};
    if (out_u <= 0) return {circle.radius - out_v, to_v};
    if (out_v <= 0) return {circle.radius - out_u, to_u};
    const double distance = std::hypot(out_u, out_v);
    return {circle.radius - distance, (out_u * to_u + out_v * to_v) / distance};
}

/// Uses the separating axis theorem with the axes of both boxes.
Overlap boxes(const Outline& a, const Outline& b, double threshold) {
    const Vector2d between = centre(b) - centre(a);
    const std::array<Vector2d, 2> axes_a = {Vector2d(a.cos_yaw, a.sin_yaw), Vector2d(-a.sin_yaw, a.cos_yaw)};
    const std::array<Vector2d, 2> axes_b = {Vector2d(b.cos_yaw, b.sin_yaw), Vector2d(-b.sin_yaw, b.cos_yaw)};
    const auto extent = [](const Outline& o, const std::array<Vector2d, 2>& axes, const Vector2d& n) {
        return o.half_x * std::abs(axes[0].dot(n)) + o.half_y * std::abs(axes[1].dot(n));
    };
    Overlap least;
    bool first = true;
    for (const auto& axis : {axes_a[0], axes_a[1], axes_b[0], axes_b[1]}) {
        const double along = between.dot(axis);
        const double depth = extent(a, axes_a, axis) + extent(b, axes_b, axis) - std::abs(along);
        if (first || depth < least.depth) least = {depth, std::copysign(1.0, along) * axis};
        if (least.depth <= threshold) break;
        first = false;
    }
    return least;
}

}  // namespace

Overlap overlap(const Outline& a, const Outline& b, double least) {
    if (a.round && b.round) return circles(a, b);
    if (b.round) return box_circle(a, b);
    if (!a.round) return boxes(a, b, least);
    Overlap turned = box_circle(b, a);
    turned.normal = -turned.normal;
    return turned;
}

double distance_to(const Outline& o, double x, double y) {
    const double dx = x - o.x, dy = y - o.y;
    if (o.round) return std::max(0.0, std::sqrt(dx * dx + dy * dy) - o.radius);
    const double out_x = std::max(0.0, std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x);
    const double out_y = std::max(0.0, std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y);
    return std::sqrt(out_x * out_x + out_y * out_y);
}

}  // namespace forage::bug
