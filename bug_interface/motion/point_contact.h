// Contacts at points, which are found for a stride and solved.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "bug_interface/motion/body.h"
#include "bug_interface/motion/overlap.h"

namespace forage::bug {

/// A body that contacts push.
struct PushedBody {
    double x, y;           ///< centre of mass, m
    double mass, inertia;  ///< kg, kg m^2
    Velocity* velocity;    ///< before the contacts; solving them changes it
};

/// A point where a body touches another one or an obstacle, or may touch it within a stride. Without
/// restitution, and with Coulomb friction.
struct PointContact {
    static constexpr std::size_t fixed = ~std::size_t{0};  ///< instead of the number of a body: an obstacle

    std::array<std::size_t, 5> name;  ///< the same in all strides
    std::size_t body, other;          ///< numbers of PushedBodies
    Overlap overlap;                  ///< its normal points from `other` to `body`
    Eigen::Vector2d point;            ///< m
    double friction;                  ///< Coulomb coefficient
    double push = 0, rub = 0;  ///< impulses along the normal and, turned to the left, along the surface, N s;
                               ///< the solution begins with those of the stride before
};

}  // namespace forage::bug
