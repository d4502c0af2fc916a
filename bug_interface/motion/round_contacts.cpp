#include "bug_interface/motion/round_contacts.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

constexpr int most_turns = 100;
constexpr double settled = 1e-6;  ///< m/s; smaller changes of all velocities end the turns

}  // namespace

std::size_t RoundContacts::add_disc(double radius, double mass, double inertia, Velocity& velocity) {
    discs_.push_back({radius, 1 / mass, 1 / inertia, &velocity});
    return discs_.size() - 1;
}

void RoundContacts::begin_stride(double steps) {
    std::swap(contacts_, before_);
    discs_.clear(), contacts_.clear();
    steps_before_ = steps_, steps_ = steps;
}

/// Prepares what stays the same in all turns, and begins with the impulses of the stride before.
void RoundContacts::prepare(Contact& c, double seconds) {
    const Disc &a = discs_[c.disc], &b = discs_[c.other];
    const bool fixed = c.disc == c.other;
    const double inverse_mass = a.inverse_mass + (fixed ? 0 : b.inverse_mass);
    c.mass = 1 / inverse_mass;
    c.rub_mass = 1 / (inverse_mass + a.radius * a.radius * a.inverse_inertia +
                      (fixed ? 0 : b.radius * b.radius * b.inverse_inertia));
    c.closing = std::max(0.0, -c.overlap.depth) / seconds;
    const auto same = std::find_if(before_.begin(), before_.end(), [&](const Contact& was) { return was.name == c.name; });
    if (same == before_.end()) return;
    c.push = same->push * steps_ / steps_before_, c.rub = same->rub * steps_ / steps_before_;
    give(c, c.push, c.rub);
}

/// Gives the discs of a contact an impulse along its normal and one along the surface.
void RoundContacts::give(const Contact& c, double push, double rub) {
    const Disc &a = discs_[c.disc], &b = discs_[c.other];
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    const double x = push * nx - rub * ny, y = push * ny + rub * nx;
    Velocity& va = *a.velocity;
    va.x += x * a.inverse_mass, va.y += y * a.inverse_mass, va.turn -= a.radius * rub * a.inverse_inertia;
    if (c.disc == c.other) return;
    Velocity& vb = *b.velocity;
    vb.x -= x * b.inverse_mass, vb.y -= y * b.inverse_mass, vb.turn -= b.radius * rub * b.inverse_inertia;
}

/// Adds the impulses that are missing at a contact. Returns the largest change of the relative velocity, m/s.
double RoundContacts::apply(Contact& c) {
    const Disc &a = discs_[c.disc], &b = discs_[c.other];
    const bool fixed = c.disc == c.other;
    const double nx = c.overlap.normal.x(), ny = c.overlap.normal.y();
    const Velocity &va = *a.velocity, vb = fixed ? Velocity{} : *b.velocity;

    const double leaving = (va.x - vb.x) * nx + (va.y - vb.y) * ny + c.closing;
    const double push = std::max(-c.push, -leaving * c.mass);
    c.push += push;
    // The surface of a disc moves against its own rotation; the tangent is the normal turned to the left.
    const double slip = (va.y - vb.y) * nx - (va.x - vb.x) * ny - a.radius * va.turn -
                        (fixed ? 0 : b.radius * vb.turn);
    const double limit = c.friction * c.push;
    const double rub = std::clamp(c.rub - slip * c.rub_mass, -limit, limit) - c.rub;
    c.rub += rub;

    give(c, push, rub);
    return std::max(std::abs(push), std::abs(rub)) * a.inverse_mass;
}

void RoundContacts::solve(double seconds) {
    for (Contact& c : contacts_) prepare(c, seconds);
    for (int turn = 0; turn < most_turns; ++turn) {
        double change = 0;
        for (Contact& c : contacts_) change = std::max(change, apply(c));
        if (change < settled) return;
    }
}

}  // namespace forage::bug
