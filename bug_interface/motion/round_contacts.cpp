#include "bug_interface/motion/round_contacts.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

constexpr int most_turns = 100;
constexpr double settled = 1e-5;  ///< m/s; smaller changes of all velocities end the turns

}  // namespace

void RoundContacts::begin_stride(double steps) {
    std::swap(contacts_, before_);
    bodies_.clear(), contacts_.clear();
    steps_before_ = steps_, steps_ = steps;
}

std::size_t RoundContacts::add_body(double x, double y, double mass, double inertia, Velocity& velocity) {
    bodies_.push_back({x, y, 1 / mass, 1 / inertia, &velocity});
    return bodies_.size() - 1;
}

void RoundContacts::add_contact(const Name& name, std::size_t body, std::size_t other, const Overlap& overlap,
                                const Eigen::Vector2d& point, double friction) {
    Contact& c = contacts_.emplace_back(Contact{name, body, other, overlap, friction});
    const double nx = overlap.normal.x(), ny = overlap.normal.y();
    double mass = 0, rub_mass = 0;  // inverse
    const auto lever_on = [&](std::size_t number) {
        if (number == fixed) return Lever{};
        const Mover& m = bodies_[number];
        const double x = point.x() - m.x, y = point.y() - m.y;
        const Lever lever{x * ny - y * nx, x * nx + y * ny};  // the tangent is the normal turned to the left
        mass += m.inverse_mass + lever.normal * lever.normal * m.inverse_inertia;
        rub_mass += m.inverse_mass + lever.tangent * lever.tangent * m.inverse_inertia;
        return lever;
    };
    c.on_body = lever_on(body), c.on_other = lever_on(other);
    c.mass = 1 / mass, c.rub_mass = 1 / rub_mass;
}

/// Gives the bodies of a contact an impulse along its normal and one along the surface, N s.
void RoundContacts::give(const Contact& c, double push, double rub) {
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    const double x = push * nx - rub * ny, y = push * ny + rub * nx;
    const auto to = [&](const Mover& m, const Lever& lever, double sign) {
        m.velocity->x += sign * x * m.inverse_mass, m.velocity->y += sign * y * m.inverse_mass;
        m.velocity->turn += sign * (push * lever.normal + rub * lever.tangent) * m.inverse_inertia;
    };
    to(bodies_[c.body], c.on_body, 1);
    if (c.other != fixed) to(bodies_[c.other], c.on_other, -1);
}

void RoundContacts::begin_with_impulses_before(Contact& c) {
    const auto same =
        std::find_if(before_.begin(), before_.end(), [&](const Contact& was) { return was.name == c.name; });
    if (same == before_.end()) return;
    c.push = same->push * steps_ / steps_before_, c.rub = same->rub * steps_ / steps_before_;
    give(c, c.push, c.rub);
}

/// Adds the impulses that are missing at a contact. Returns the largest change of a velocity, m/s.
double RoundContacts::apply(Contact& c) {
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    const Velocity &a = *bodies_[c.body].velocity,
                   b = c.other == fixed ? Velocity{} : *bodies_[c.other].velocity;
    const double leaving = (a.x - b.x) * nx + (a.y - b.y) * ny + a.turn * c.on_body.normal -
                           b.turn * c.on_other.normal + c.closing;
    const double push = std::max(-c.push, -leaving * c.mass);
    c.push += push;
    // As if `push` had no effect on the slip; for discs that is so, and for others the turns see to it.
    const double slip =
        (a.y - b.y) * nx - (a.x - b.x) * ny + a.turn * c.on_body.tangent - b.turn * c.on_other.tangent;
    const double limit = c.friction * c.push;
    const double rub = std::clamp(c.rub - slip * c.rub_mass, -limit, limit) - c.rub;
    c.rub += rub;
    give(c, push, rub);
    return std::max(std::abs(push), std::abs(rub)) * bodies_[c.body].inverse_mass;
}

void RoundContacts::solve(double seconds) {
    for (Contact& c : contacts_) {
        c.closing = std::max(0.0, -c.overlap.depth) / seconds;
        begin_with_impulses_before(c);
    }
    for (int turn = 0; turn < most_turns; ++turn) {
        double change = 0;
        for (Contact& c : contacts_) change = std::max(change, apply(c));
        if (change < settled) return;
    }
}

}  // namespace forage::bug
