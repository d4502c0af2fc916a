// Upright solids, and the outline that a horizontal plane cuts out of one.
#pragma once

#include <optional>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// A box, an upright cylinder or a sphere somewhere in the world. Never a plane.
struct Solid {
    ShapeKind kind = ShapeKind::box;
    Pose pose = Pose::Identity();  ///< in the world; only its yaw turns the solid
    Eigen::Vector3d size =
        Eigen::Vector3d::Zero();  ///< as in Shape: full extents, or diameters (and length), m
};

/// A rectangle or a circle in the plane, world frame, metres.
struct Outline {
    bool round = false;
    double x = 0, y = 0;              ///< the middle
    double cos_yaw = 1, sin_yaw = 0;  ///< of a rectangle: how far it is turned
    double half_x = 0, half_y = 0;    ///< of a rectangle: half its extents, along its own axes
    double radius = 0;                ///< of a circle
};

/// What the plane z = `height` (m) cuts out of `solid`; empty when it misses. Of a sphere: the circle of the
/// cut.
std::optional<Outline> cut(const Solid& solid, double height);

}  // namespace forage::bug
