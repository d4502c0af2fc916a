// Rigid bodies in the plane and the obstacles around them, as the physics sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// Shapes collide only when they share heights. Heights are divided into at most max_layers layers; a mask
/// has one bit per layer.
using LayerMask = std::uint32_t;
inline constexpr std::size_t max_layers = 32;

/// A shape that never moves, seen from above.
struct Obstacle {
    Outline outline;
    double friction = 1;     ///< Coulomb coefficient; a contact has the smaller one of its two surfaces
    LayerMask layers = ~0u;  ///< the layers that the shape extends into
};

/// A shape of a body beside its central disc, in the frame of the body.
struct Part {
    Outline outline;
    int layer = 0;
    double friction = 0.1;  ///< Coulomb coefficient
};

/// A robot, which is driven, or a movable object, which keeps its velocity until contacts or the friction of
/// the floor change it.
struct Body {
    double radius = 0.2;    ///< radius of the central disc, m; 0 for a body without one
    double mass = 5;        ///< kg
    double inertia = 1;     ///< about the vertical axis, kg m^2
    double friction = 0.1;  ///< Coulomb coefficient of the central disc
    int layer = 0;          ///< layer of the central disc
    std::vector<Part> parts;
    bool driven = true;               ///< false for a movable object
    double deceleration = 0;          ///< deceleration of a movable object on the floor, m/s^2
    double angular_deceleration = 0;  ///< the same for its rotation, rad/s^2
};

/// The mass of a body in contacts, kg. With impulses, a heavy body would push a light one through a wall, so
/// movable objects are at least as heavy as the heaviest robot (kg). This changes little, as robots get the
/// velocity of their command in every step, whatever mass they push.
inline double contact_mass(const Body& body, double heaviest_robot) {
    return body.driven || body.mass > heaviest_robot ? body.mass : heaviest_robot;
}

/// The velocity of a body in world coordinates.
struct Velocity {
    double x = 0, y = 0, turn = 0;  ///< m/s, m/s, rad/s
    friend bool operator==(const Velocity&, const Velocity&) = default;
};
inline bool is_zero(const Velocity& v) { return v.x == 0 && v.y == 0 && v.turn == 0; }

/// How far a robot can move by itself in one time step at most.
struct Reach {
    double travel = 0;  ///< length of its path, m
    double turn = 0;    ///< rad
    double parts = 0;   ///< displacement of any point of its parts within its frame, m
};

}  // namespace forage::bug
