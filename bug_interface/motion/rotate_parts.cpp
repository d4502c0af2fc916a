// The motion of parts within a body: the fingers of a gripper.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/bullet_world.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double tolerance = 1e-5;  ///< m; shapes may overlap by this

/// An upper bound of the displacement of any point of a shape, m.
double displacement_bound(const Outline& from, const Outline& to) {
    return std::hypot(to.x - from.x, to.y - from.y) +
           bounding_radius(to) * std::hypot(to.cos_yaw - from.cos_yaw, to.sin_yaw - from.sin_yaw);
}

/// Whether the motion of a shape from `from` to `to` makes it overlap `other`, or overlap it more.
bool overlaps_more(BulletWorld& bullet, const Outline& other, const Outline& from, const Outline& to) {
    if (!closer_than(other, to, bounding_radius(other) + bounding_radius(to))) return false;
    const double gap = bullet.gap(other, to).distance;
    return gap < -tolerance && gap < bullet.gap(other, from).distance;
}

}  // namespace

/// Whether an obstacle or another robot blocks the motion of a part to the outline `target`.
bool Physics::is_blocked(std::size_t body, const Part& part, const Outline& target) const {
    const Transform2 pose(states_[body].pose);
    const Outline from = pose * part.outline, to = pose * target;
    bool blocked = false;
    for_each_obstacle_near(
        body, reach_[body].parts * static_cast<double>(steps_), [&](const Obstacle& o, std::size_t) {
            blocked |= o.layers >> part.layer & 1u && overlaps_more(*bullet_, o.outline, from, to);
        });
    for (const std::size_t other : near_[body]) {
        const State& s = states_[other];
        if (blocked || !bodies_[other].driven ||
            !closer_than(to, s.pose, bounding_radius(to) + s.bounding_radius))
            continue;
        for_each_shape(other, s.pose, [&](const Outline& o, int layer, double) {
            blocked |= can_collide(LayerMask{1} << part.layer, layer) && overlaps_more(*bullet_, o, from, to);
        });
    }
    return blocked;
}

/// Whether a body can move from one pose to another without overlapping another shape more than before.
bool Physics::can_move(std::size_t body, const Pose2& from, const Pose2& to) const {
    bool free = true;
    const auto test = [&](const Outline& before, const Outline& after, int layer) {
        for (const Obstacle& o : obstacles_)
            if (o.layers >> layer & 1u) free &= !overlaps_more(*bullet_, o.outline, before, after);
        for (std::size_t other = 0; other < states_.size(); ++other) {
            const State& s = states_[other];
            if (other == body || !s.present ||
                !closer_than(after, s.pose, bounding_radius(after) + s.bounding_radius))
                continue;
            for_each_shape(other, s.pose, [&](const Outline& o, int other_layer, double) {
                if (can_collide(LayerMask{1} << layer, other_layer))
                    free &= !overlaps_more(*bullet_, o, before, after);
            });
        }
    };
    const Transform2 pose_before(from);
    auto part = bodies_[body].parts.begin();
    bool is_disc = bodies_[body].radius > 0;  // the central disc comes first
    for_each_shape(body, to, [&](const Outline& after, int layer, double) {
        Outline before = after;
        if (is_disc)
            before.x = from.x, before.y = from.y, is_disc = false;
        else
            before = pose_before * (part++)->outline;
        test(before, after, layer);
    });
    return free;
}

bool Physics::is_collision_free(std::size_t body, const Pose2& pose) const {
    const double far = 1e6;  // m; nothing overlaps the body there
    return can_move(body, {pose.x + far, pose.y, pose.yaw}, pose);
}

/// Pushes movable objects out of parts that have moved from `outlines_before_`. Returns false when an object
/// cannot be pushed; the objects in `pushed_` have moved in either case.
bool Physics::push_objects(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts) {
    const State& state = states_[body];
    const Transform2 pose(state.pose);
    for (const std::size_t object : near_[body]) {
        State& other = states_[object];
        if (bodies_[object].driven) continue;
        const double distance = std::hypot(other.pose.x - state.pose.x, other.pose.y - state.pose.y);
        if (distance > state.bounding_radius + other.bounding_radius + 0.01) continue;
        const Pose2 from = other.pose;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const Outline after = pose * parts[i].second, before = pose * outlines_before_[i];
            const int layer = bodies_[body].parts[parts[i].first].layer;
            BulletWorld::Gap deepest{0, Eigen::Vector2d::Zero()};
            for_each_shape(object, other.pose, [&](const Outline& o, int object_layer, double) {
                if (!can_collide(LayerMask{1} << layer, object_layer)) return;
                const BulletWorld::Gap gap = bullet_->gap(o, after);
                if (gap.distance < std::min(-tolerance, deepest.distance) &&
                    gap.distance < bullet_->gap(o, before).distance)
                    deepest = gap;
            });
            other.pose.x -= deepest.distance * deepest.normal.x();
            other.pose.y -= deepest.distance * deepest.normal.y();
        }
        if (other.pose.x == from.x && other.pose.y == from.y) continue;
        pushed_.emplace_back(object, from);
        if (!can_move(object, from, other.pose)) return false;
    }
    return true;
}

bool Physics::rotate_parts(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts) {
    State& state = states_[body];
    Body& shape = bodies_[body];
    double displacement = 0;
    for (const auto& [number, outline] : parts)
        displacement = std::max(displacement, displacement_bound(shape.parts[number].outline, outline));
    const bool free = !state.present || !may_touch_something(body, displacement);
    if (!free)
        for (const auto& [number, outline] : parts)
            if (is_blocked(body, shape.parts[number], outline)) return false;

    // All parts move first. Objects that they overlap then are pushed; if that fails, everything is undone.
    outlines_before_.clear(), pushed_.clear(), shape_caches_[body].valid = false;
    for (const auto& [number, outline] : parts)
        outlines_before_.push_back(std::exchange(shape.parts[number].outline, outline));
    if (!free && !push_objects(body, parts)) {
        for (const auto& [object, from] : pushed_) states_[object].pose = from;
        for (std::size_t i = 0; i < parts.size(); ++i)
            shape.parts[parts[i].first].outline = outlines_before_[i];
        return false;
    }
    const double radius_before = state.bounding_radius;
    update_bounding_radius(body);
    if (state.bounding_radius > radius_before) state.obstacle_clearance = 0;
    state.moved(displacement);
    for (const auto& [object, from] : pushed_)
        states_[object].moved(std::hypot(states_[object].pose.x - from.x, states_[object].pose.y - from.y));
    return true;
}

/// Reads or writes the poses of the parts of a body; everything else about them is constant.
void Physics::checkpoint_parts(std::size_t body, Archive& archive) {
    auto& parts = bodies_[body].parts;
    for (Part& p : parts) archive(p.outline.x, p.outline.y, p.outline.cos_yaw, p.outline.sin_yaw);
    shape_caches_[body].valid = false;
}

}  // namespace forage::bug
