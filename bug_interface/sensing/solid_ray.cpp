#include "bug_interface/sensing/solid_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/simd.h"

namespace forage::bug {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The interval of a ray inside the intersection of slabs and round shapes; empty when leave < enter. There
/// are no branches, so that loops over rays are vectorised.
struct Inside {
    double enter = -infinity, leave = infinity, face = Entries::curved;

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
        face = nearer > enter ? Entries::curved : face;
        enter = nearer > enter ? nearer : enter;
        leave = farther < leave ? farther : leave;
    }

    [[gnu::always_inline]] void store(double* depth, double* through) const {
        *depth = enter > 0 && enter <= leave ? enter : infinity;
        *through = face;
    }
};

/// The constants of one solid for all rays.
struct SolidConstants {
    double turn[9];  ///< rotation matrix, row by row
    double origin[3], half[3];
};

FORAGE_SIMD void enter_box(const SolidConstants f, const float* x, const float* y, const float* z,
                           std::size_t count, double* depth, double* face) {
    const double* t = f.turn;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = x[i], b = y[i], c = z[i];
        Inside inside;
        inside.slab(0, f.origin[0], t[0] * a + t[1] * b + t[2] * c, f.half[0]);
        inside.slab(1, f.origin[1], t[3] * a + t[4] * b + t[5] * c, f.half[1]);
        inside.slab(2, f.origin[2], t[6] * a + t[7] * b + t[8] * c, f.half[2]);
        inside.store(&depth[i], &face[i]);
    }
}

FORAGE_SIMD void enter_cylinder(const SolidConstants f, const float* x, const float* y, const float* z,
                                std::size_t count, double* depth, double* face) {
    const double* t = f.turn;
    const double rest = f.origin[0] * f.origin[0] + f.origin[1] * f.origin[1] - f.half[0] * f.half[0];
    for (std::size_t i = 0; i < count; ++i) {
        const double a = x[i], b = y[i], c = z[i];
        const double dx = t[0] * a + t[1] * b + t[2] * c, dy = t[3] * a + t[4] * b + t[5] * c,
                     dz = t[6] * a + t[7] * b + t[8] * c;
        Inside inside;
        inside.round(dx * dx + dy * dy, f.origin[0] * dx + f.origin[1] * dy, rest);
        inside.slab(2, f.origin[2], dz, f.half[2]);
        inside.store(&depth[i], &face[i]);
    }
}

FORAGE_SIMD void enter_sphere(const SolidConstants f, const float* x, const float* y, const float* z,
                              std::size_t count, double* depth, double* face) {
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
        inside.store(&depth[i], &face[i]);
    }
}

}  // namespace

void intersect(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
               const Eigen::Matrix3d& rotation, const Rays& rays, const Entries& out) {
    SolidConstants f;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) f.turn[3 * row + column] = rotation(row, column);
        f.origin[row] = origin[row], f.half[row] = half[row];
    }
    switch (kind) {
        case ShapeKind::box:
            return enter_box(f, rays.x, rays.y, rays.z, rays.count, out.depth, out.face);
        case ShapeKind::cylinder:
            return enter_cylinder(f, rays.x, rays.y, rays.z, rays.count, out.depth, out.face);
        case ShapeKind::sphere:
            return enter_sphere(f, rays.x, rays.y, rays.z, rays.count, out.depth, out.face);
        case ShapeKind::plane:
            std::fill_n(out.depth, rays.count, infinity);
    }
}

Eigen::Vector3d curved_normal(ShapeKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double depth) {
    Eigen::Vector3d normal = origin + depth * direction;
    if (kind == ShapeKind::cylinder) normal.z() = 0;
    return normal.normalized();
}

}  // namespace forage::bug
