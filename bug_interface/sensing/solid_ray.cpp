#include "bug_interface/sensing/solid_ray.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/simd.h"

namespace forage::bug {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The interval of a ray inside the intersection of slabs and round shapes; empty when leave < enter. There
/// are no branches, so that loops over rays are vectorised.
struct Inside {
    double enter = -infinity, leave = infinity, face = Nearest::curved;

    /// Intersects with the slab |x_axis| <= half.
    [[gnu::always_inline]] void slab(int axis, double origin, double direction, double half) {
        const bool along = std::abs(direction) < 1e-12;
        const double inverse = 1 / (along ? 1.0 : direction);
        const double centre = -origin * inverse, reach = half * std::abs(inverse);
        const double nearer = along ? -infinity : centre - reach;
        const double farther = along ? (std::abs(origin) > half ? -infinity : infinity) : centre + reach;
        const double side = direction > 0 ? 2.0 * axis + 1 : 2.0 * axis;
        face = nearer > enter ? side : face;
        enter = nearer > enter ? nearer : enter;
        leave = farther < leave ? farther : leave;
    }

    /// Intersects with a sphere or an infinite cylinder: direction^2 t^2 + 2 mixed t + rest <= 0.
    [[gnu::always_inline]] void round(double direction_squared, double mixed, double rest) {
        const bool along = direction_squared < 1e-24;
        const double inverse = 1 / (along ? 1.0 : direction_squared);
        const double discriminant = along ? -rest : mixed * mixed - direction_squared * rest;
        const double root = std::sqrt(discriminant > 0 ? discriminant : 0.0);
        const double nearer = along ? -infinity : (-mixed - root) * inverse;
        const double farther = discriminant < 0 ? -infinity : (along ? infinity : (-mixed + root) * inverse);
        face = nearer > enter ? Nearest::curved : face;
        enter = nearer > enter ? nearer : enter;
        leave = farther < leave ? farther : leave;
    }

    /// Keeps the entry when it is nearer than the nearest one so far.
    [[gnu::always_inline]] void keep(double first_face, double& depth, double& entry,
                                     double& nearest_face) const {
        const double at = enter > 0 && enter <= leave ? enter : infinity;
        const bool nearer = at < depth;
        depth = nearer ? static_cast<double>(static_cast<float>(at)) : depth;
        entry = nearer ? at : entry;
        nearest_face = nearer ? first_face + face : nearest_face;
    }
};

FORAGE_SIMD void meet_box(const SolidInView f, const float* __restrict x, const float* __restrict y,
                          const float* __restrict z, std::size_t count, double first_face,
                          double* __restrict depth, double* __restrict entry, double* __restrict face) {
    const double* t = f.turn;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = x[i], b = y[i], c = z[i];
        Inside inside;
        inside.slab(0, f.origin[0], t[0] * a + t[1] * b + t[2] * c, f.half[0]);
        inside.slab(1, f.origin[1], t[3] * a + t[4] * b + t[5] * c, f.half[1]);
        inside.slab(2, f.origin[2], t[6] * a + t[7] * b + t[8] * c, f.half[2]);
        inside.keep(first_face, depth[i], entry[i], face[i]);
    }
}

FORAGE_SIMD void meet_cylinder(const SolidInView f, const float* __restrict x, const float* __restrict y,
                               const float* __restrict z, std::size_t count, double first_face,
                               double* __restrict depth, double* __restrict entry, double* __restrict face) {
    const double* t = f.turn;
    const double rest = f.origin[0] * f.origin[0] + f.origin[1] * f.origin[1] - f.half[0] * f.half[0];
    for (std::size_t i = 0; i < count; ++i) {
        const double a = x[i], b = y[i], c = z[i];
        const double dx = t[0] * a + t[1] * b + t[2] * c, dy = t[3] * a + t[4] * b + t[5] * c,
                     dz = t[6] * a + t[7] * b + t[8] * c;
        Inside inside;
        inside.round(dx * dx + dy * dy, f.origin[0] * dx + f.origin[1] * dy, rest);
        inside.slab(2, f.origin[2], dz, f.half[2]);
        inside.keep(first_face, depth[i], entry[i], face[i]);
    }
}

FORAGE_SIMD void meet_sphere(const SolidInView f, const float* __restrict x, const float* __restrict y,
                             const float* __restrict z, std::size_t count, double first_face,
                             double* __restrict depth, double* __restrict entry, double* __restrict face) {
    const double* t = f.turn;
    const double rest = f.origin[0] * f.origin[0] + f.origin[1] * f.origin[1] + f.origin[2] * f.origin[2] -
                        f.half[0] * f.half[0];
    for (std::size_t i = 0; i < count; ++i) {
        const double a = x[i], b = y[i], c = z[i];
        const double dx = t[0] * a + t[1] * b + t[2] * c, dy = t[3] * a + t[4] * b + t[5] * c,
                     dz = t[6] * a + t[7] * b + t[8] * c;
        Inside inside;
        inside.round(dx * dx + dy * dy + dz * dz, f.origin[0] * dx + f.origin[1] * dy + f.origin[2] * dz,
                     rest);
        inside.keep(first_face, depth[i], entry[i], face[i]);
    }
}

struct Vector {
    double x, y, z;
};

/// A row of a matrix times a vector, summed as Eigen does.
[[gnu::always_inline]] inline double dot(const double* row, const Vector& v) {
    return row[0] * v.x + (row[1] * v.y + row[2] * v.z);
}

/// What shading needs, as plain numbers.
struct Surface {
    bool upright;  ///< whether normals are horizontal in the frame of the solid
    double to_world[9], sun[3];
};

FORAGE_SIMD void shade(const SolidInView f, const Surface surface, const float* __restrict x,
                       const float* __restrict y, const float* __restrict z, std::size_t count,
                       const double* __restrict entry, float* __restrict lit) {
    for (std::size_t i = 0; i < count; ++i) {
        const Vector ray{x[i], y[i], z[i]};
        Vector n{f.origin[0] + entry[i] * dot(f.turn, ray), f.origin[1] + entry[i] * dot(f.turn + 3, ray),
                 surface.upright ? 0.0 : f.origin[2] + entry[i] * dot(f.turn + 6, ray)};
        const double square = n.x * n.x + (n.y * n.y + n.z * n.z);
        const double length = std::sqrt(square > 0 ? square : 1.0);
        n.x /= length, n.y /= length, n.z /= length;
        const Vector normal{dot(surface.to_world, n), dot(surface.to_world + 3, n),
                            dot(surface.to_world + 6, n)};
        const double towards = dot(surface.sun, normal);
        lit[i] = static_cast<float>(towards > 0 ? towards : 0.0);
    }
}

void copy_rows(const Eigen::Matrix3d& from, double* to) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) to[3 * row + column] = from(row, column);
}

}  // namespace

SolidInView::SolidInView(ShapeKind shape, const Eigen::Vector3d& half_extents, const Eigen::Vector3d& eye,
                         const Eigen::Matrix3d& rotation)
    : kind(shape) {
    copy_rows(rotation, turn);
    for (int axis = 0; axis < 3; ++axis) origin[axis] = eye[axis], half[axis] = half_extents[axis];
}

void meet(const SolidInView& solid, const Rays& rays, double first_face, const Nearest& nearest) {
    switch (solid.kind) {
        case ShapeKind::box:
            return meet_box(solid, rays.x, rays.y, rays.z, rays.count, first_face, nearest.depth,
                            nearest.entry, nearest.face);
        case ShapeKind::cylinder:
            return meet_cylinder(solid, rays.x, rays.y, rays.z, rays.count, first_face, nearest.depth,
                                 nearest.entry, nearest.face);
        case ShapeKind::sphere:
            return meet_sphere(solid, rays.x, rays.y, rays.z, rays.count, first_face, nearest.depth,
                               nearest.entry, nearest.face);
        case ShapeKind::plane:
            return;
    }
}

Eigen::Vector3d curved_normal(ShapeKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double depth) {
    Eigen::Vector3d normal = origin + depth * direction;
    if (kind == ShapeKind::cylinder) normal.z() = 0;
    return normal.normalized();
}

void shade_curved(const SolidInView& solid, const Eigen::Matrix3d& to_world, const Lighting& lighting,
                  const Material& material, const Rays& rays, const double* entry, float* rgb) {
    Surface surface{solid.kind == ShapeKind::cylinder, {}, {}};
    copy_rows(to_world, surface.to_world);
    std::array<float, 128> lit{};
    if (lighting.sun) {
        for (int axis = 0; axis < 3; ++axis) surface.sun[axis] = (*lighting.sun)[axis];
        shade(solid, surface, rays.x, rays.y, rays.z, rays.count, entry, lit.data());
    }
    const Colour ambient = material.ambient * lighting.ambient;
    for (std::size_t i = 0; i < rays.count; ++i)
        Eigen::Map<Colour>(rgb + 4 * i) = (ambient + material.diffuse * lit[i]).min(1.0f).max(0.0f);
}

}  // namespace forage::bug
