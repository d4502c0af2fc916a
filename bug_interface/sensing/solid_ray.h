// Intersections of rays with a solid.
#pragma once

#include <span>

#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// Half the height of the bounding box of `solid`, m; an upper bound for tilted round solids.
inline double half_height(const Solid& solid) {
    return 0.5 * solid.pose.linear().row(2).cwiseAbs().dot(solid.size);
}

/// The square of the radius of the bounding sphere of `solid`, m^2.
inline double radius_squared(const Solid& solid) {
    if (solid.kind == ShapeKind::sphere) return solid.size.x() * solid.size.x() / 4;
    if (solid.kind == ShapeKind::cylinder)
        return Eigen::Vector2d(solid.size.x(), solid.size.z()).squaredNorm() / 4;
    return solid.size.squaredNorm() / 4;
}

/// The outward normal of a flat face: face 2 * axis is on the positive side of the axis, and 2 * axis + 1 on
/// the negative side.
inline Eigen::Vector3d face_normal(int face) { return Eigen::Vector3d::Unit(face / 2) * (face % 2 ? -1 : 1); }

/// Rays from one point. Ray i has the direction (x[i], y[i], z[i]).
struct Rays {
    const float *x, *y, *z;
    std::size_t count;
};

/// The points where rays enter a solid from outside.
struct Entries {
    static constexpr double curved = 6;
    double* depth;  ///< > 0, in units of the ray's direction; infinity when it misses or starts inside
    double* face;   ///< the face number of face_normal(), or `curved`
};

/// Intersects rays with a box, cylinder or sphere that has the half extents `half` in its own frame. In that
/// frame the rays start at `origin` and have the directions `rotation` * ray. Rays never meet a
/// ShapeKind::plane.
void intersect(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
               const Eigen::Matrix3d& rotation, const Rays& rays, const Entries& out);

/// The outward unit normal at the point where a ray enters a cylinder or sphere through its curved face.
Eigen::Vector3d curved_normal(ShapeKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double depth);

}  // namespace forage::bug
