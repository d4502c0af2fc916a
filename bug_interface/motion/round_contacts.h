// Contacts at one point: those of round shapes with each other and with boxes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bug_interface/motion/body.h"
#include "bug_interface/motion/overlap.h"

namespace forage::bug {

/// Changes the velocities of bodies so that none moves into another one or into an obstacle, with Coulomb
/// friction and without restitution: every contact gets the impulse that stops it, in turns, until nothing
/// changes (projected Gauss-Seidel). It takes contacts at one point, which are all those of a round shape. A
/// single one is exact after one turn; in corners, where friction converges slowly, beginning with the
/// impulses of the stride before saves most turns. The result is that of Bullet's solver; Bullet's general
/// search for contacts and its rows take much longer.
class RoundContacts {
  public:
    /// The name of a contact, which is the same in all strides.
    using Name = std::array<std::size_t, 4>;
    static constexpr std::size_t fixed = ~std::size_t{0};  ///< instead of the number of a body: an obstacle

    /// Forgets all contacts, so that the next stride does not begin with their impulses.
    void forget() { contacts_.clear(); }
    /// Begins a stride of `steps` time steps, without bodies and contacts.
    void begin_stride(double steps);
    /// Adds a body with its centre of mass at (x, y), m; returns its number. `mass` in kg, `inertia` in kg
    /// m^2. solve() changes `velocity`.
    std::size_t add_body(double x, double y, double mass, double inertia, Velocity& velocity);
    /// Adds a possible contact of `body` with the body `other` at `point`. The normal of `overlap` points
    /// from `other` to `body`.
    void add_contact(const Name& name, std::size_t body, std::size_t other, const Overlap& overlap,
                     const Eigen::Vector2d& point, double friction);
    /// Solves all contacts for a motion of `seconds` with constant velocities. A gap may close in this time.
    void solve(double seconds);

  private:
    struct Mover {
        double x, y, inverse_mass, inverse_inertia;
        Velocity* velocity;
    };
    /// How a contact acts on one of its bodies: the torque of a unit impulse along the normal and the
    /// tangent.
    struct Lever {
        double normal = 0, tangent = 0;  ///< m
    };
    struct Contact {
        Name name;
        std::size_t body, other;
        Overlap overlap;
        double friction;
        Lever on_body{}, on_other{};
        double push = 0, rub = 0;       ///< impulses along the normal and along the surface, N s
        double mass = 0, rub_mass = 0;  ///< impulse per change of the relative velocity, kg
        double closing = 0;             ///< the velocity at which the gap may close, m/s
    };
    void begin_with_impulses_before(Contact& contact);
    void give(const Contact& contact, double push, double rub);
    double apply(Contact& contact);

    std::vector<Mover> bodies_;
    std::vector<Contact> contacts_, before_;  ///< of this stride and of the one before
    double steps_ = 1, steps_before_ = 1;
};

}  // namespace forage::bug
