// Islands: which bodies may meet each other within some steps, and how many steps can be one stride.
//
// Within these steps no body moves further than twice as far as the fastest could by itself (Physics::move()
// sees to it). Bodies whose surroundings of this size do not overlap cannot meet, and the others, directly or
// through others, form an island.
//
// Every body has a clearance, for obstacles and for the bodies of its island: the gap between two bodies is
// at least the sum of their clearances. Motion reduces the clearance of a body; it is measured again when it
// is too small for the next stride. Clearance from obstacles stays valid in later steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bug_interface/motion/bullet_world.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// How far from itself a body looks for obstacles, m. Its clearance is never larger.
constexpr double sight = 1;
constexpr double contact_stride = 0.02;  ///< m; how far bodies move in a stride while they touch
constexpr double contact_turn = 0.05;    ///< rad; the same for rotations
constexpr std::uint64_t contact_steps_at_once = 20;
constexpr double max_turn = 0.5;  ///< rad; how far a body turns in any stride
/// Gap between bounding circles below which the shapes are compared, m.
constexpr double shape_test_distance = 0.1;

/// The distance from the point (x, y) to an outline, m; 0 inside.
double distance_to(const Outline& o, double x, double y) {
    const double dx = x - o.x, dy = y - o.y;
    if (o.round) return std::max(0.0, std::sqrt(dx * dx + dy * dy) - o.radius);
    const double out_x = std::max(0.0, std::abs(o.cos_yaw * dx + o.sin_yaw * dy) - o.half_x);
    const double out_y = std::max(0.0, std::abs(o.cos_yaw * dy - o.sin_yaw * dx) - o.half_y);
    return std::sqrt(out_x * out_x + out_y * out_y);
}

}  // namespace

/// Gap between the bounding circles of two bodies, m; negative when they overlap.
double Physics::circle_gap(std::size_t a, std::size_t b) const {
    const Pose2 &at_a = states_[a].pose, &at_b = states_[b].pose;
    const double dx = at_b.x - at_a.x, dy = at_b.y - at_a.y;
    return std::sqrt(dx * dx + dy * dy) - states_[a].bounding_radius - states_[b].bounding_radius;
}

/// Distance of the outermost point of a body from its rotation axis, m; 0 for a disc, which a rotation does
/// not change.
double Physics::lever_arm(std::size_t body) const {
    return bodies_[body].parts.empty() ? 0 : states_[body].bounding_radius;
}

/// The shapes of a body in world coordinates: the central disc, then the parts.
const std::vector<Physics::PlacedShape>& Physics::shapes(std::size_t body) {
    ShapeCache& cache = shape_caches_[body];
    State& state = states_[body];
    const Pose2& pose = state.pose;
    if (cache.valid && cache.pose.x == pose.x && cache.pose.y == pose.y && cache.pose.yaw == pose.yaw)
        return cache.shapes;
    cache.shapes.clear();
    state.update_rotation();
    for_each_shape(
        body, Transform2(pose.x, pose.y, state.cos_yaw, state.sin_yaw),
        [&](const Outline& outline, int layer, double friction) {
            cache.shapes.push_back({outline, cache.shapes.size(), layer, bounding_radius(outline), friction});
        });
    cache.pose = pose, cache.valid = true;
    return cache.shapes;
}

/// A lower bound of the gap between the shapes of two bodies, m, of at most `limit` or circle_gap(). At most
/// 0 when any two of them overlap.
double Physics::shape_gap(std::size_t a, std::size_t b, double limit) {
    double gap = limit;
    for_each_pair(a, b, limit, [&](const PlacedShape& p, const PlacedShape& q) {
        gap = std::min(gap, bullet_->gap(p.outline, q.outline, limit).distance);
    });
    return std::max(gap, circle_gap(a, b));
}

/// The outline of a shape of a body, at `pose`.
Outline Physics::outline(std::size_t body, std::size_t index, const Pose2& pose) const {
    const std::size_t discs = bodies_[body].radius > 0 ? 1 : 0;
    if (index >= discs) return Transform2(pose) * bodies_[body].parts[index - discs].outline;
    Outline disc;
    disc.round = true, disc.x = pose.x, disc.y = pose.y, disc.radius = bodies_[body].radius;
    return disc;
}

/// Sets the clearances of a body to the smallest gap to an obstacle and to half the smallest gap to a body of
/// its island. The clearances of the other bodies shrink to half the gap, too.
void Physics::measure_clearance(std::size_t body) {
    State& state = states_[body];
    state.measured = true;
    state.obstacle_clearance = sight;
    for_each_obstacle_near(body, sight, [&](const Obstacle& o, std::size_t) {
        const double gap = distance_to(o.outline, state.pose.x, state.pose.y) - state.bounding_radius;
        state.obstacle_clearance = std::min(state.obstacle_clearance, gap);
    });
    if (state.obstacle_clearance < shape_test_distance && lever_arm(body) > 0) {
        double of_shapes = shape_test_distance;
        for_each_obstacle_pair(body, shape_test_distance, [&](const PlacedShape& p, const PlacedShape& o) {
            of_shapes = std::min(of_shapes, bullet_->gap(p.outline, o.outline, shape_test_distance).distance);
        });
        state.obstacle_clearance = std::max(state.obstacle_clearance, of_shapes);
    }
    state.body_clearance = infinity;
    for (const std::size_t other : near_[body]) {
        double gap = circle_gap(body, other);
        if (gap < shape_test_distance && lever_arm(body) + lever_arm(other) > 0) {
            if (state.clearance() >= near_distance)
                gap = shape_gap(body, other, shape_test_distance);
            else if (states_[other].clearance() >= near_distance)  // the body touches something in any case
                states_[other].measured = false;
        }
        state.body_clearance = std::min(state.body_clearance, gap / 2);
        states_[other].body_clearance = std::min(states_[other].body_clearance, gap / 2);
    }
}

/// Whether a body may touch something while no point of it moves by more than `displacement`, m.
bool Physics::may_touch_something(std::size_t body, double displacement) {
    if (states_[body].clearance() >= displacement + near_distance) return false;
    if (!states_[body].measured) measure_clearance(body);
    return states_[body].clearance() < displacement + near_distance;
}

/// An upper bound of the displacement of any point of a body that travels `travel` (m) and turns by `turn`
/// (rad), m.
double Physics::max_displacement(std::size_t body, double travel, double turn) const {
    return travel + turn * lever_arm(body);
}

/// An upper bound of the displacement of any point of a body in a step in which nothing pushes it, m.
double Physics::displacement_per_step(std::size_t body) const {
    if (!bodies_[body].driven) return max_displacement(body, velocities_[body], step_);
    const Reach& r = reach_[body];
    return max_displacement(body, r.travel, r.turn) + r.parts;
}

void Physics::begin(std::span<const Reach> reach, std::uint64_t steps) {
    steps_ = steps;
    members_.clear(), islands_.clear();
    push_ = 0;
    const double n = static_cast<double>(steps);
    for (std::size_t i = 0; i < states_.size(); ++i) {
        State& s = states_[i];
        if (!s.present) continue;
        if (bodies_[i].driven) reach_[i] = reach[i];
        near_[i].clear();
        s.body_clearance = infinity, s.displacement = 0, s.robot_contacts = 0;
        members_.push_back(i);
        push_ = std::max(push_, 2 * n * displacement_per_step(i));
    }
    if (members_.size() > 1) find_pairs();
    // A stable order: bodies by their number, islands by their first body.
    for (const std::size_t i : members_) root_[i] = find_root(i);
    std::sort(members_.begin(), members_.end(), [&](std::size_t a, std::size_t b) {
        return root_[a] != root_[b] ? root_[a] < root_[b] : a < b;
    });
    for (std::size_t k = 0; k < members_.size(); ++k) {
        const std::size_t i = members_[k];
        if (k == 0 || root_[i] != root_[members_[k - 1]]) islands_.push_back({k, 0, false});
        ++islands_.back().count;
        if (!near_[i].empty()) states_[i].body_clearance = 0, states_[i].measured = false;
    }
    for (Island& island : islands_) {
        const std::size_t body = members_[island.first];
        island.free = island.count == 1 && stepping_ == Stepping::strides &&
                      !may_touch_something(body, n * displacement_per_step(body));
    }
}

std::size_t Physics::find_root(std::size_t body) {
    while (root_[body] != body) body = root_[body] = root_[root_[body]];
    return body;
}

/// Finds the pairs of bodies that may meet, and joins them. The root of an island is its first body.
void Physics::find_pairs() {
    std::iota(root_.begin(), root_.end(), 0);
    areas_.clear();
    double largest = 0;
    for (const std::size_t i : members_) {
        const State& s = states_[i];
        const double surroundings = s.bounding_radius + push_ + near_distance;
        areas_.push_back(Area::around(s.pose.x, s.pose.y, surroundings));
        largest = std::max(largest, 2 * surroundings);
    }
    body_grid_.assign(areas_, largest);
    for (std::size_t k = 0; k < members_.size(); ++k)
        body_grid_.visit(areas_[k], [&](std::size_t other) {
            const std::size_t a = members_[k], b = members_[other];
            if (b >= a) return;
            const bool apart = circle_gap(a, b) >= 2 * (push_ + near_distance);
            if (apart && stepping_ == Stepping::strides) return;
            near_[a].push_back(b), near_[b].push_back(a);
        });
    for (const std::size_t a : members_) {
        std::sort(near_[a].begin(), near_[a].end());
        for (const std::size_t b : near_[a]) {
            const std::size_t of_a = find_root(a), of_b = find_root(b);
            root_[std::max(of_a, of_b)] = std::min(of_a, of_b);
        }
    }
}

/// While nothing is near, a stride ends where something may be; while bodies touch, it is a few steps.
std::uint64_t Physics::stride(std::size_t island, std::uint64_t left) {
    if (left == 1 || stepping_ == Stepping::single) return 1;
    const auto steps_of = [](double distance, double per_step, std::uint64_t most) {
        const double steps = distance / per_step;
        return steps < 1 ? 1 : steps < static_cast<double>(most) ? static_cast<std::uint64_t>(steps) : most;
    };
    for (const std::size_t i : this->island(island)) {
        const double per_step = displacement_per_step(i);
        if (per_step == 0) continue;
        const double turn = bodies_[i].driven ? reach_[i].turn : std::abs(velocities_[i].turn) * step_;
        left = std::min(left, steps_of(max_turn, turn, left));
        const std::uint64_t in_contact = std::min(steps_of(contact_stride, per_step, contact_steps_at_once),
                                                  steps_of(contact_turn, turn, left));
        const bool contact =
            may_touch_something(i, static_cast<double>(in_contact) * per_step) && states_[i].touching;
        left = std::min(
            left, contact ? in_contact : steps_of(states_[i].clearance() - near_distance, per_step, left));
    }
    return left;
}

/// Activates the bodies near active ones, as they may be pushed.
void Physics::activate_neighbours(std::span<const std::size_t> bodies, double seconds) {
    for (bool more = true; more;) {
        more = false;
        for (const std::size_t i : bodies) {
            if (!states_[i].active) continue;
            for (const std::size_t j : near_[i]) {
                State& other = states_[j];
                if (other.active) continue;
                const double distance =
                    4 * near_distance + 2 * (max_displacement(i, velocities_[i], seconds) +
                                             max_displacement(j, velocities_[j], seconds));
                if (shape_gap(i, j, distance) < distance) other.active = more = true;
            }
        }
    }
}

}  // namespace forage::bug
