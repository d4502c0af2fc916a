// Intersections of rays with a solid.
#pragma once

#include <span>

#include "bug_interface/sensing/grid.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"
#include "bug_interface/world/material.h"

namespace forage::bug {

/// Half the height of the bounding box of `solid`, m; an upper bound for tilted round solids.
double half_height(const Solid& solid);
/// The square of the radius of the bounding sphere of `solid`, m^2.
double radius_squared(const Solid& solid);
/// The bounding rectangle of `solid` in the plane.
Area area_of(const Solid& solid);
/// The outward normal of a flat face: face 2 * axis is on the positive side of the axis, and 2 * axis + 1 on
/// the negative side.
Eigen::Vector3d face_normal(int face);

/// Rays from one point. Ray i has the direction (x[i], y[i], z[i]).
struct Rays {
    const float *x, *y, *z;
    std::size_t count;  ///< a multiple of four
};

/// A box, cylinder or sphere as rays see it. It has the half extents `half` in its own frame, in which the
/// rays start at `origin` and have the directions `rotation` * ray. Rays never meet a ShapeKind::plane.
struct SolidInView {
    ShapeKind kind;
    double turn[9];  ///< the rotation, row by row
    double origin[3], half[3];

    SolidInView(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
                const Eigen::Matrix3d& rotation);
};

/// The nearest surfaces that rays have met so far.
struct Nearest {
    static constexpr double curved = 6;  ///< the face of a point that is on no flat face
    double* depth;                       ///< > 0, in units of the ray's direction, in single precision
    double* entry;                       ///< the same in double precision, where a solid is nearest
    double* face;                        ///< the number of the face, which selects its colour
};

/// Finds the rays that enter `solid` from outside nearer than `nearest`, and sets their depth, their entry
/// and their face: `first_face` + that of face_normal(), or + Nearest::curved.
void intersect(const SolidInView& solid, const Rays& rays, double first_face, const Nearest& nearest);

/// Writes how much of the light from `sun`, a unit vector, falls on the points where rays enter the curved
/// face of `solid`, at the depths `entry`: max(0, sun * to_world * normal) to the bit. Other rays get any
/// numbers.
void light_curved(const SolidInView& solid, const Eigen::Matrix3d& to_world, const Eigen::Vector3d& sun,
                  const Rays& rays, const double* entry, double* lit);

}  // namespace forage::bug
