// Who is near what: which bodies Bullet has to look at in a step.
//
// Every body has some room: the gap between any two is at least the sum of theirs. Motion uses it up, and
// what does not last for the next step is measured anew.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double near_enough = 0.001;  ///< m; well above the errors of Bullet's single precision
constexpr double worth_a_look =
    0.1;  ///< m between circles round bodies, below which their shapes are looked at

/// Distance from point (x, y) to an outline, 0 inside.
double distance_to(const Outline& o, double x, double y) {
    const double dx = x - o.x, dy = y - o.y;
    if (o.round) return std::max(0.0, std::sqrt(dx * dx + dy * dy) - o.radius);
    const double out_x = std::max(0.0, std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x);
    const double out_y = std::max(0.0, std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y);
    return std::sqrt(out_x * out_x + out_y * out_y);
}

}  // namespace

double Physics::apart(std::size_t a, std::size_t b) const {
    const Pose2 &here = states_[a].pose, &there = states_[b].pose;
    const double dx = there.x - here.x, dy = there.y - here.y;
    return std::sqrt(dx * dx + dy * dy) - states_[a].reach - states_[b].reach;
}

/// How far the ends of a body are from the axis that it turns about; 0 for a round one.
double Physics::lever(std::size_t body) const {
    return bodies_[body].parts.empty() ? 0 : states_[body].reach;
}

/// Where the shapes of a body are in the world: its middle, then its parts.
const std::vector<Physics::Placed>& Physics::shapes(std::size_t body) {
    Standing& s = standing_[body];
    State& state = states_[body];
    const Pose2& pose = state.pose;
    if (s.known && s.at.x == pose.x && s.at.y == pose.y && s.at.yaw == pose.yaw) return s.shapes;
    s.shapes.clear();
    state.face();
    each_shape(body, Frame(pose.x, pose.y, state.cos_yaw, state.sin_yaw),
               [&](const Outline& outline, int layer) {
                   s.shapes.push_back({outline, layer, reach(outline)});
               });
    s.at = pose, s.known = true;
    return s.shapes;
}

/// A bound for the gap between the shapes of two bodies, at least as good as that between their circles.
double Physics::gap_between(std::size_t body, std::size_t other) {
    double gap = std::numeric_limits<double>::infinity();
    for (const Placed& a : shapes(body))
        for (const Placed& b : shapes(other)) {
            // Circles round them first: most shapes are far from each other.
            const double near = gap + a.reach + b.reach;
            const double dx = b.outline.x - a.outline.x, dy = b.outline.y - a.outline.y;
            if (near >= 0 && dx * dx + dy * dy >= near * near) continue;
            if (meet(LayerMask{1} << a.layer, b.layer))
                gap = std::min(gap, -overlap(a.outline, b.outline).depth);
        }
    return std::max(gap, apart(body, other));
}

/// Whether shapes of two bodies may be nearer than that to each other.
bool Physics::may_be_nearer(std::size_t body, std::size_t other, double than) {
    if (apart(body, other) >= than) return false;
    for (const Placed& a : shapes(body))
        for (const Placed& b : shapes(other)) {
            const double near = than + a.reach + b.reach;
            const double dx = b.outline.x - a.outline.x, dy = b.outline.y - a.outline.y;
            if (dx * dx + dy * dy < near * near && meet(LayerMask{1} << a.layer, b.layer) &&
                overlap(a.outline, b.outline, -than).depth > -than)
                return true;
        }
    return false;
}

/// Of a gap between two bodies each may use one half.
void Physics::measure_room(std::size_t body) {
    State& state = states_[body];
    double gap = std::numeric_limits<double>::infinity();
    for (const Obstacle& o : obstacles_) {
        if (!(o.layers & state.layers)) continue;
        double to_it = distance_to(o.outline, state.pose.x, state.pose.y) - state.reach;
        if (to_it >= gap) continue;
        if (to_it < worth_a_look && lever(body) > 0) {
            double of_shapes = std::numeric_limits<double>::infinity();
            for (const Placed& shape : shapes(body))
                if (o.layers >> shape.layer & 1u)
                    of_shapes = std::min(of_shapes, -overlap(o.outline, shape.outline).depth);
            to_it = std::max(to_it, of_shapes);
        }
        gap = std::min(gap, to_it);
    }
    for (std::size_t other = 0; other < states_.size(); ++other) {
        if (other == body || !states_[other].present) continue;
        double between = apart(body, other);
        if (between < worth_a_look && lever(body) + lever(other) > 0) between = gap_between(body, other);
        gap = std::min(gap, between / 2);
        states_[other].room = std::min(states_[other].room, between / 2);
    }
    state.room = gap;
}

bool Physics::near_something(std::size_t body, double way) {
    if (states_[body].room >= way + near_enough) return false;
    measure_room(body);
    return states_[body].room < way + near_enough;
}

/// Whether parts of a body may move by so much for sure. Others may have used more than they had.
bool Physics::has_room_for(std::size_t body, double way) {
    double missing = 0;
    for (const State& s : states_)
        if (s.present) missing = std::max(missing, -s.room);
    const double needed = way + missing + near_enough;
    if (states_[body].room < needed) measure_room(body);
    return states_[body].room >= needed;
}

/// How far any point of a body gets in a step at most, m.
double Physics::way(std::size_t body, double travel, double turn) const {
    return travel + turn * lever(body);
}

/// Whoever is near one that is near something has to be looked at too: it may be pushed.
void Physics::involve_neighbours() {
    const auto reaches = [&](std::size_t i) {
        const Velocity& v = velocities_[i];
        return way(i, std::sqrt(v.x * v.x + v.y * v.y), std::abs(v.turn));
    };
    for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            if (!states_[i].involved) continue;
            for (std::size_t j = 0; j < states_.size(); ++j) {
                State& other = states_[j];
                if (other.involved || !other.present) continue;
                const double near = 4 * near_enough + 2 * step_ * (reaches(i) + reaches(j));
                if (may_be_nearer(i, j, near)) other.involved = more = true;
            }
        }
    }
}

}  // namespace forage::bug
