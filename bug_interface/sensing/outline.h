// Solids, their horizontal cross-sections, and rigid transforms in the plane.
#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// A box, an upright cylinder or a sphere, but never a plane.
struct Solid {
    ShapeKind kind = ShapeKind::box;
    Pose pose = Pose::Identity();  ///< pose in the world; only the yaw turns the solid
    Eigen::Vector3d size =
        Eigen::Vector3d::Zero();  ///< full extents, or diameters and length, as in Shape, m
};

/// A rectangle or a circle in the plane, in world coordinates unless stated otherwise, m.
struct Outline {
    bool round = false;               ///< true for a circle
    double x = 0, y = 0;              ///< centre
    double cos_yaw = 1, sin_yaw = 0;  ///< orientation of a rectangle
    double half_x = 0, half_y = 0;    ///< half the extents of a rectangle, along its own axes
    double radius = 0;                ///< radius of a circle
};

/// The cross-section of `solid` with the plane z = `height` (m). Empty when the plane misses the solid.
std::optional<Outline> cross_section(const Solid& solid, double height);

/// The radius of a circle around the centre of `outline` that contains the outline, m.
inline double bounding_radius(const Outline& outline) {
    return outline.round ? outline.radius
                         : std::sqrt(outline.half_x * outline.half_x + outline.half_y * outline.half_y);
}

/// Whether the positions `a` and `b` (outlines or poses) are less than `distance` apart, m. False for a
/// `distance` of 0.
template <class A, class B>
bool closer_than(const A& a, const B& b, double distance) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    return dx * dx + dy * dy < distance * distance;
}

/// A rotation followed by a translation in the plane. The sine and the cosine are computed only once.
class Transform2 {
  public:
    explicit Transform2(const Pose2& pose)
        : Transform2(pose.x, pose.y, std::cos(pose.yaw), std::sin(pose.yaw)) {}
    Transform2(double x, double y, double cos_yaw, double sin_yaw)
        : x_(x), y_(y), cos_(cos_yaw), sin_(sin_yaw) {}

    double x() const { return x_; }  ///< translation, m
    double y() const { return y_; }  ///< translation, m

    Eigen::Vector2d operator*(const Eigen::Vector2d& point) const {
        return {x_ + cos_ * point.x() - sin_ * point.y(), y_ + sin_ * point.x() + cos_ * point.y()};
    }
    Outline operator*(const Outline& outline) const;

  private:
    double x_, y_, cos_, sin_;
};

}  // namespace forage::bug
