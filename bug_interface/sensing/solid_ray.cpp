#include "bug_interface/sensing/solid_ray.h"

#include <cmath>
#include <limits>

namespace forage::bug {
namespace {

/// The part of a ray inside what has been intersected so far; empty when leave < enter.
struct Inside {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    int face = Entry::curved;

    void nothing() { leave = -std::numeric_limits<double>::infinity(); }

    /// Intersects with the slab |x_axis| <= half.
    void slab(int axis, double origin, double direction, double half) {
        if (std::abs(direction) < 1e-12) {
            if (std::abs(origin) > half) nothing();
            return;
        }
        const double middle = -origin / direction, reach = half / std::abs(direction);
        if (middle - reach > enter) enter = middle - reach, face = 2 * axis + (direction > 0);
        leave = std::min(leave, middle + reach);
    }

    /// Intersects with a ball or an endless cylinder: direction^2 t^2 + 2 mixed t + rest <= 0.
    void round(double direction_squared, double mixed, double rest) {
        if (direction_squared < 1e-24) {
            if (rest > 0) nothing();
            return;
        }
        const double discriminant = mixed * mixed - direction_squared * rest;
        if (discriminant < 0) return nothing();
        const double root = std::sqrt(discriminant);
        const double first = (-mixed - root) / direction_squared;
        if (first > enter) enter = first, face = Entry::curved;
        leave = std::min(leave, (-mixed + root) / direction_squared);
    }
};

}  // namespace

std::optional<Entry> enter(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction) {
    const double radius = half.x();
    if (kind == ShapeKind::cylinder && origin.z() > half.z() &&
        direction.z() < 0) {  // from above: often through the lid
        const double depth = (half.z() - origin.z()) / direction.z();
        const Eigen::Vector2d lid = origin.head<2>() + depth * direction.head<2>();
        if (lid.squaredNorm() <= radius * radius) return Entry{depth, 4, Eigen::Vector3d::Zero()};
    }
    Inside inside;
    switch (kind) {
        case ShapeKind::box:
            for (int axis = 0; axis < 3; ++axis) inside.slab(axis, origin[axis], direction[axis], half[axis]);
            break;
        case ShapeKind::cylinder:
            inside.round(direction.head<2>().squaredNorm(), origin.head<2>().dot(direction.head<2>()),
                         origin.head<2>().squaredNorm() - radius * radius);
            inside.slab(2, origin.z(), direction.z(), half.z());
            break;
        case ShapeKind::sphere:
            inside.round(direction.squaredNorm(), origin.dot(direction),
                         origin.squaredNorm() - radius * radius);
            break;
        case ShapeKind::plane:
            return {};
    }
    if (!(inside.enter > 0 && inside.enter <= inside.leave)) return {};
    Entry entry{inside.enter, inside.face, Eigen::Vector3d::Zero()};
    if (entry.face == Entry::curved) {
        entry.normal = origin + entry.depth * direction;
        if (kind == ShapeKind::cylinder) entry.normal.z() = 0;
        entry.normal.normalize();
    }
    return entry;
}

}  // namespace forage::bug
