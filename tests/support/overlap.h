// The penetration depth of two outlines, in closed form: what tests compare the physics with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// How far two outlines penetrate each other.
struct Overlap {
    double depth = 0;  ///< penetration depth, m; negative values are a lower bound of the gap
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector; moves the second outline out
};

namespace detail {

using Eigen::Vector2d;

inline Vector2d centre(const Outline& o) { return {o.x, o.y}; }

inline Overlap circles(const Outline& a, const Outline& b) {
    const Vector2d between = centre(b) - centre(a);
    const double distance = between.norm();
    return {a.radius + b.radius - distance, distance > 0 ? Vector2d(between / distance) : Vector2d(1, 0)};
}

inline Overlap box_circle(const Outline& box, const Outline& circle) {
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
inline Overlap boxes(const Outline& a, const Outline& b, double threshold) {
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

}  // namespace detail

/// The overlap of `b` with `a`. The depth is exact when it is less than half the smaller outline. For
/// outlines apart, -depth is a lower bound of the gap.
inline Overlap overlap(const Outline& a, const Outline& b) {
    constexpr double least = -std::numeric_limits<double>::infinity();
    using namespace detail;
    if (a.round && b.round) return circles(a, b);
    if (b.round) return box_circle(a, b);
    if (!a.round) return boxes(a, b, least);
    Overlap turned = box_circle(b, a);
    turned.normal = -turned.normal;
    return turned;
}

}  // namespace forage::bug
