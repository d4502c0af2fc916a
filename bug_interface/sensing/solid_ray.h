// Where rays enter a solid.
#pragma once

#include <span>

#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

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

/// Outward normal of flat face `face`: 2 * axis, + 1 on the negative side.
inline Eigen::Vector3d face_normal(int face) { return Eigen::Vector3d::Unit(face / 2) * (face % 2 ? -1 : 1); }

/// Rays from one point, in a frame of their own: ray i has the direction (x[i], y[i], z[i]).
struct Rays {
    const float *x, *y, *z;
    std::size_t count;
};

/// Where rays enter a solid from outside.
struct Entries {
    static constexpr double curved = 6;
    double* depth;  ///< in units of the ray's direction, > 0; infinity where it misses, or starts inside
    double* face;   ///< a number as for face_normal(), or curved
};

/// Meets a box, cylinder or sphere with half extents `half` in a frame of its own, where the rays begin at
/// `origin` and have the directions `turn` * ray. All rays miss a plane.
void enter(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
           const Eigen::Matrix3d& turn, const Rays& rays, const Entries& out);

/// Outward normal, of unit length, where a ray enters a cylinder or sphere through its curved face.
Eigen::Vector3d curved_normal(ShapeKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double depth);

}  // namespace forage::bug
