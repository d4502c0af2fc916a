#include "bug_interface/motion/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace forage::bug {
namespace {

constexpr int max_turns = 100;
constexpr double settled = 1e-5;  ///< m/s, rad/s; smaller changes of all velocities in a turn end the turns

}  // namespace

ContactSolver::Row ContactSolver::row_of(std::span<const PushedBody> bodies, PointContact& c,
                                         double seconds) {
    Row row{&c, {}, {}};
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    double mass = 0, rub_mass = 0;  // inverse
    const auto lever_on = [&](std::size_t number) {
        if (number == PointContact::fixed) return Lever{};
        const PushedBody& b = bodies[number];
        const double x = c.point.x() - b.x, y = c.point.y() - b.y;
        // The tangent is the normal turned to the left.
        const Lever lever{b.velocity, 1 / b.mass, 1 / b.inertia, x * ny - y * nx, x * nx + y * ny};
        mass += lever.inverse_mass + lever.normal * lever.normal * lever.inverse_inertia;
        rub_mass += lever.inverse_mass + lever.tangent * lever.tangent * lever.inverse_inertia;
        return lever;
    };
    row.body = lever_on(c.body), row.other = lever_on(c.other);
    row.mass = 1 / mass, row.rub_mass = 1 / rub_mass;
    row.closing = std::max(0.0, -c.overlap.depth) / seconds;
    return row;
}

/// Gives the bodies of a contact an impulse along its normal and one along the surface, N s.
void ContactSolver::give(const Row& row, double push, double rub) {
    const double nx = row.contact->overlap.normal.x(), ny = row.contact->overlap.normal.y();
    const double x = push * nx - rub * ny, y = push * ny + rub * nx;
    const auto to = [&](const Lever& l, double sign) {
        l.velocity->x += sign * x * l.inverse_mass, l.velocity->y += sign * y * l.inverse_mass;
        l.velocity->turn += sign * (push * l.normal + rub * l.tangent) * l.inverse_inertia;
    };
    to(row.body, 1);
    if (row.other.velocity) to(row.other, -1);
}

/// Adds the impulses that are missing at a contact.
void ContactSolver::apply(const Row& row) {
    PointContact& c = *row.contact;
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    const Velocity &a = *row.body.velocity, b = row.other.velocity ? *row.other.velocity : Velocity{};
    const double leaving = (a.x - b.x) * nx + (a.y - b.y) * ny + a.turn * row.body.normal -
                           b.turn * row.other.normal + row.closing;
    const double push = std::max(-c.push, -leaving * row.mass);
    c.push += push;
    // As if `push` had no effect on the slip; for discs that is so, and for others the turns see to it.
    const double slip =
        (a.y - b.y) * nx - (a.x - b.x) * ny + a.turn * row.body.tangent - b.turn * row.other.tangent;
    const double limit = c.friction * c.push;
    const double rub = std::clamp(c.rub - slip * row.rub_mass, -limit, limit) - c.rub;
    c.rub += rub;
    give(row, push, rub);
}

void ContactSolver::solve(std::span<const PushedBody> bodies, std::span<PointContact> contacts,
                          double seconds) {
    rows_.clear();
    for (PointContact& c : contacts) {
        rows_.push_back(row_of(bodies, c, seconds));
        if (c.push != 0) give(rows_.back(), c.push, c.rub);
    }
    velocities_.clear();
    for (const PushedBody& b : bodies) velocities_.push_back(*b.velocity);
    for (int turn = 0; turn < max_turns; ++turn) {
        for (const Row& row : rows_) apply(row);
        double change = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const Velocity &v = *bodies[i].velocity, was = std::exchange(velocities_[i], v);
            change =
                std::max({change, std::abs(v.x - was.x), std::abs(v.y - was.y), std::abs(v.turn - was.turn)});
        }
        if (change < settled) return;
    }
}

}  // namespace forage::bug
