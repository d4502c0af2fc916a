// The impulses of contacts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bug_interface/motion/point_contact.h"

namespace forage::bug {

/// Changes the velocities of bodies so that none moves into another one or into an obstacle: every contact
/// gets the impulse that stops it, in turns, until nothing changes (projected Gauss-Seidel). A single contact
/// is exact after one turn; in corners, where friction converges slowly, beginning with the impulses of the
/// stride before saves most turns. Velocities are those of Bullet's solver (BulletContacts), which computes
/// in three dimensions and single precision, and takes four times as long per turn.
class ContactSolver {
  public:
    /// Solves all contacts for a motion of `seconds` with constant velocities. A gap may close in this time.
    void solve(std::span<const PushedBody> bodies, std::span<PointContact> contacts, double seconds);

  private:
    /// How a contact acts on one of its bodies.
    struct Lever {
        Velocity* velocity = nullptr;  ///< null for an obstacle
        double inverse_mass = 0, inverse_inertia = 0;
        double normal = 0, tangent = 0;  ///< torque of a unit impulse along the normal and the tangent, m
    };
    struct Row {
        PointContact* contact;
        Lever body, other;
        double mass = 0, rub_mass = 0;  ///< impulse per change of the relative velocity, kg
        double closing = 0;             ///< the velocity at which the gap may close, m/s
    };
    static Row row_of(std::span<const PushedBody> bodies, PointContact& contact, double seconds);
    static void give(const Row& row, double push, double rub);
    static void apply(const Row& row);

    std::vector<Row> rows_;
    std::vector<Velocity> velocities_;  ///< after the last turn
};

}  // namespace forage::bug
