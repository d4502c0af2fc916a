// Contacts of discs with each other and with obstacles.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "bug_interface/motion/body.h"
#include "bug_interface/motion/overlap.h"

namespace forage::bug {

/// Changes the velocities of discs so that none moves into another one or into an obstacle, with Coulomb
/// friction and without restitution: every contact gets the impulse that stops it, in turns, until nothing
/// changes (projected Gauss-Seidel). A single contact with an obstacle is exact after one turn; in corners,
/// where friction converges slowly, beginning with the impulses of the stride before saves most turns. The
/// result is that of Bullet's solver; its general search for contacts and its rows take 20 times as long.
class RoundContacts {
  public:
    /// The name of a contact, which is the same in all strides.
    using Name = std::pair<std::size_t, std::size_t>;

    /// Forgets all contacts, so that the next stride does not begin with their impulses.
    void forget() { contacts_.clear(); }
    /// Begins a stride of `steps` time steps, without discs and contacts.
    void begin_stride(double steps);
    /// Adds a disc; returns its number. `radius` in m, `mass` in kg, `inertia` in kg m^2. solve() changes
    /// `velocity`.
    std::size_t add_disc(double radius, double mass, double inertia, Velocity& velocity);
    /// Adds a possible contact of a disc with an obstacle. The normal of `overlap` points to the disc.
    void add_contact(Name name, std::size_t disc, const Overlap& overlap, double friction) {
        contacts_.push_back({name, disc, disc, overlap, friction});
    }
    /// Adds a possible contact of two discs. The normal of `overlap` points from `other` to `disc`.
    void add_contact(Name name, std::size_t disc, std::size_t other, const Overlap& overlap, double friction) {
        contacts_.push_back({name, disc, other, overlap, friction});
    }
    /// Solves all contacts for a motion of `seconds` with constant velocities. A gap may close in this time.
    void solve(double seconds);

  private:
    struct Disc {
        double radius, inverse_mass, inverse_inertia;
        Velocity* velocity;
    };
    struct Contact {
        Name name;
        std::size_t disc, other;  ///< the same number for a contact with an obstacle
        Overlap overlap;
        double friction;
        double push = 0, rub = 0;            ///< impulses along the normal and along the surface, N s
        double mass = 0, rub_mass = 0;       ///< impulse per change of the relative velocity, kg
        double closing = 0;                  ///< the velocity at which the gap may close, m/s
    };
    void prepare(Contact& contact, double seconds);
    void give(const Contact& contact, double push, double rub);
    double apply(Contact& contact);

    std::vector<Disc> discs_;
    std::vector<Contact> contacts_, before_;  ///< of this stride and of the one before
    double steps_ = 1, steps_before_ = 1;
};

}  // namespace forage::bug
