// Where a ray enters a solid.
#pragma once

#include <optional>

#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// A point where a ray enters a solid from outside.
struct Entry {
    static constexpr int curved = 6;
    double depth = 0;        ///< in units of the ray's direction
    int face = curved;       ///< 2 * axis, + 1 on the negative side; or curved
    Eigen::Vector3d normal;  ///< of a curved face: outwards, unit length, in the solid's frame
};

/// How far `solid` reaches above and below its middle (a bound for tilted round ones), m.
inline double half_height(const Solid& solid) {
    return 0.5 * solid.pose.linear().row(2).cwiseAbs().dot(solid.size);
}

/// Square of the radius of a sphere round `solid`, m^2.
inline double radius_squared(const Solid& solid) {
    if (solid.kind == ShapeKind::sphere) return solid.size.x() * solid.size.x() / 4;
    if (solid.kind == ShapeKind::cylinder)
        return Eigen::Vector2d(solid.size.x(), solid.size.z()).squaredNorm() / 4;
    return solid.size.squaredNorm() / 4;
}

/// Outward normal of flat face `face`.
inline Eigen::Vector3d face_normal(int face) { return Eigen::Vector3d::Unit(face / 2) * (face % 2 ? -1 : 1); }

/// Where the ray origin + depth * direction (depth > 0, in the frame of the solid) enters a box, cylinder or
/// sphere with half extents `half`. Empty when it misses, or starts inside.
std::optional<Entry> enter(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction);

}  // namespace forage::bug
