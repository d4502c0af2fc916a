#include "bug_interface/sensing/solid_ray.h"

#include <limits>

#include "bug_interface/sensing/four.h"
#include "core/base/simd.h"

namespace forage::bug {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The intervals of four rays inside the intersection of slabs and round shapes; empty when leave < enter.
struct RayInterval {
    Four enter = four(-infinity), leave = four(infinity), face = four(Nearest::curved);

    /// Intersects with the slab |x_axis| <= half.
    [[gnu::always_inline]] void slab(int axis, double origin, const Four& direction, double half) {
        const auto along = magnitude(direction) < 1e-12;
        const Four inverse = 1 / (along ? four(1) : direction);
        const Four centre = -four(origin) * inverse, reach = half * magnitude(inverse);
        const Four nearer = along ? four(-infinity) : centre - reach;
        const Four outside = magnitude(four(origin)) > half ? four(-infinity) : four(infinity);
        const Four farther = along ? outside : centre + reach;
        const Four side = direction > 0 ? four(2.0 * axis + 1) : four(2.0 * axis);
        face = nearer > enter ? side : face;
        enter = nearer > enter ? nearer : enter;
        leave = farther < leave ? farther : leave;
    }

    /// Intersects with a sphere or an infinite cylinder: direction^2 t^2 + 2 mixed t + rest <= 0.
    [[gnu::always_inline]] void round(const Four& direction_squared, const Four& mixed, const Four& rest) {
        const auto along = direction_squared < 1e-24;
        const Four inverse = 1 / (along ? four(1) : direction_squared);
        const Four discriminant = along ? -rest : mixed * mixed - direction_squared * rest;
        const Four half = square_root(discriminant > 0 ? discriminant : four(0));
        const Four nearer = along ? four(-infinity) : (-mixed - half) * inverse;
        const Four farther =
            discriminant < 0 ? four(-infinity) : (along ? four(infinity) : (-mixed + half) * inverse);
        face = nearer > enter ? four(Nearest::curved) : face;
        enter = nearer > enter ? nearer : enter;
        leave = farther < leave ? farther : leave;
    }
};

/// Finds the entries into a solid: `narrow` gets the directions of four rays in the frame of the solid.
/// Those that are nearer than the nearest ones so far are kept.
template <class Narrow>
[[gnu::always_inline]] inline void intersect_each(const SolidInView& f, const Rays& rays, double first_face,
                                                  const Nearest& nearest, Narrow narrow) {
    const double* t = f.turn;
    for (std::size_t i = 0; i < rays.count; i += 4) {
        const Four a = load(rays.x + i), b = load(rays.y + i), c = load(rays.z + i);
        RayInterval interval;
        narrow(interval, t[0] * a + t[1] * b + t[2] * c, t[3] * a + t[4] * b + t[5] * c,
               t[6] * a + t[7] * b + t[8] * c);
        const Four depth = load(nearest.depth + i), entry = load(nearest.entry + i),
                   face = load(nearest.face + i);
        const auto nearer =
            (interval.enter > 0) & (interval.enter <= interval.leave) & (interval.enter < depth);
        store(nearer ? rounded_to_single(interval.enter) : depth, nearest.depth + i);
        store(nearer ? interval.enter : entry, nearest.entry + i);
        store(nearer ? first_face + interval.face : face, nearest.face + i);
    }
}

FORAGE_SIMD void intersect_box(const SolidInView& f, const Rays& rays, double first_face,
                               const Nearest& nearest) {
    intersect_each(
        f, rays, first_face, nearest,
        [&](RayInterval & interval, const Four& x, const Four& y, const Four& z)
            __attribute__((always_inline)) {
                interval.slab(0, f.origin[0], x, f.half[0]);
                interval.slab(1, f.origin[1], y, f.half[1]);
                interval.slab(2, f.origin[2], z, f.half[2]);
            });
}

FORAGE_SIMD void intersect_cylinder(const SolidInView& f, const Rays& rays, double first_face,
                                    const Nearest& nearest) {
    const Four x0 = four(f.origin[0]), y0 = four(f.origin[1]), radius = four(f.half[0]),
               rest = x0 * x0 + y0 * y0 - radius * radius;
    intersect_each(
        f, rays, first_face, nearest,
        [&](RayInterval & interval, const Four& x, const Four& y, const Four& z)
            __attribute__((always_inline)) {
                interval.round(x * x + y * y, x0 * x + y0 * y, rest);
                interval.slab(2, f.origin[2], z, f.half[2]);
            });
}

FORAGE_SIMD void intersect_sphere(const SolidInView& f, const Rays& rays, double first_face,
                                  const Nearest& nearest) {
    const Four x0 = four(f.origin[0]), y0 = four(f.origin[1]), z0 = four(f.origin[2]),
               radius = four(f.half[0]), rest = x0 * x0 + y0 * y0 + z0 * z0 - radius * radius;
    intersect_each(
        f, rays, first_face, nearest,
        [&](RayInterval & interval, const Four& x, const Four& y, const Four& z) __attribute__((
            always_inline)) { interval.round(x * x + y * y + z * z, x0 * x + y0 * y + z0 * z, rest); });
}

/// A row of a matrix times a vector, summed as Eigen does.
template <class Number>
[[gnu::always_inline]] inline Number dot(const double* row, const Number& x, const Number& y,
                                         const Number& z) {
    return row[0] * x + (row[1] * y + row[2] * z);
}

/// What light() needs, as plain numbers.
struct Surface {
    bool upright;  ///< whether normals are horizontal in the frame of the solid
    double to_world[9], sun[3];
};

FORAGE_SIMD void light(const SolidInView& f, const Surface& surface, const Rays& rays, const double* entry,
                       double* lit) {
    for (std::size_t i = 0; i < rays.count; i += 4) {
        const Four a = load(rays.x + i), b = load(rays.y + i), c = load(rays.z + i), depth = load(entry + i);
        Four x = f.origin[0] + depth * dot(f.turn, a, b, c),
             y = f.origin[1] + depth * dot(f.turn + 3, a, b, c),
             z = surface.upright ? four(0) : f.origin[2] + depth * dot(f.turn + 6, a, b, c);
        const Four square = x * x + (y * y + z * z), length = square_root(square > 0 ? square : four(1));
        x /= length, y /= length, z /= length;
        const double* w = surface.to_world;
        const Four towards = dot(surface.sun, dot(w, x, y, z), dot(w + 3, x, y, z), dot(w + 6, x, y, z));
        store(towards > 0 ? towards : four(0), lit + i);
    }
}

void copy_rows(const Eigen::Matrix3d& from, double* to) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) to[3 * row + column] = from(row, column);
}

}  // namespace

double half_height(const Solid& solid) { return 0.5 * solid.pose.linear().row(2).cwiseAbs().dot(solid.size); }

double radius_squared(const Solid& solid) {
    if (solid.kind == ShapeKind::sphere) return solid.size.x() * solid.size.x() / 4;
    if (solid.kind == ShapeKind::cylinder)
        return Eigen::Vector2d(solid.size.x(), solid.size.z()).squaredNorm() / 4;
    return solid.size.squaredNorm() / 4;
}

Area area_of(const Solid& solid) {
    const Eigen::Vector2d middle = solid.pose.translation().head<2>(),
                          half = solid.pose.linear().topRows<2>().cwiseAbs() * solid.size / 2;
    return {middle.x() - half.x(), middle.y() - half.y(), middle.x() + half.x(), middle.y() + half.y()};
}

Eigen::Vector3d face_normal(int face) { return Eigen::Vector3d::Unit(face / 2) * (face % 2 ? -1 : 1); }

SolidInView::SolidInView(ShapeKind shape, const Eigen::Vector3d& half_extents, const Eigen::Vector3d& eye,
                         const Eigen::Matrix3d& rotation)
    : kind(shape) {
    copy_rows(rotation, turn);
    for (int axis = 0; axis < 3; ++axis) origin[axis] = eye[axis], half[axis] = half_extents[axis];
}

void intersect(const SolidInView& solid, const Rays& rays, double first_face, const Nearest& nearest) {
    switch (solid.kind) {
        case ShapeKind::box:
            return intersect_box(solid, rays, first_face, nearest);
        case ShapeKind::cylinder:
            return intersect_cylinder(solid, rays, first_face, nearest);
        case ShapeKind::sphere:
            return intersect_sphere(solid, rays, first_face, nearest);
        case ShapeKind::plane:
            return;
    }
}

void light_curved(const SolidInView& solid, const Eigen::Matrix3d& to_world, const Eigen::Vector3d& sun,
                  const Rays& rays, const double* entry, double* lit) {
    Surface surface{solid.kind == ShapeKind::cylinder, {}, {}};
    copy_rows(to_world, surface.to_world);
    for (int axis = 0; axis < 3; ++axis) surface.sun[axis] = sun[axis];
    light(solid, surface, rays, entry, lit);
}

}  // namespace forage::bug
