// Parts of a body that move within it: the fingers of a gripper.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/contacts.h"
#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double tolerance = 1e-6;  ///< m, that shapes may overlap

bool may_touch(const Outline& a, double x, double y, double reach_there) {
    const double near = reach(a) + reach_there, dx = x - a.x, dy = y - a.y;
    return dx * dx + dy * dy < near * near;
}

/// How far any point of a shape gets at most, m.
double motion(const Outline& from, const Outline& to) {
    return std::hypot(to.x - from.x, to.y - from.y) +
           reach(to) * std::hypot(to.cos_yaw - from.cos_yaw, to.sin_yaw - from.sin_yaw);
}

/// Whether `then` is deeper in something than it was and may be.
bool worse(const Outline& thing, const Outline& now, const Outline& then) {
    if (!may_touch(thing, then.x, then.y, reach(then))) return false;
    const double depth = overlap(thing, then).depth;
    return depth > tolerance && depth > overlap(thing, now).depth;
}

}  // namespace

bool Physics::fixed_in_the_way(std::size_t body, const Part& now, const Outline& then, int layer) const {
    const Pose2& pose = states_[body].pose;
    const Outline was = moved(now.outline, pose), is = moved(then, pose);
    for (const Obstacle& o : obstacles_)
        if (o.layers >> layer & 1u && worse(o.outline, was, is)) return true;
    for (std::size_t other = 0; other < states_.size(); ++other) {
        const State& s = states_[other];
        if (other == body || !s.present || !bodies_[other].driven ||
            !may_touch(is, s.pose.x, s.pose.y, s.reach))
            continue;
        bool blocked = false;
        each_shape(other, s.pose, [&](const Outline& o, int there) {
            blocked |= meet(LayerMask{1} << layer, there) && worse(o, was, is);
        });
        if (blocked) return true;
    }
    return false;
}

/// Whether a loose thing may be moved: nothing that is there would be in it, or deeper than it was.
bool Physics::is_free(std::size_t thing, const Pose2& from, const Pose2& to) const {
    const Frame before(from);
    bool free = true;
    const auto look = [&](const Outline& was, const Outline& is, int layer) {
        for (const Obstacle& o : obstacles_)
            if (o.layers >> layer & 1u) free &= !worse(o.outline, was, is);
        for (std::size_t other = 0; other < states_.size(); ++other) {
            const State& s = states_[other];
            if (other == thing || !s.present || !may_touch(is, s.pose.x, s.pose.y, s.reach)) continue;
            each_shape(other, s.pose, [&](const Outline& o, int there) {
                if (meet(LayerMask{1} << layer, there)) free &= !worse(o, was, is);
            });
        }
    };
    const Body& body = bodies_[thing];
    auto part = body.parts.begin();
    bool middle = body.radius > 0;  // it comes first
    each_shape(thing, to, [&](const Outline& is, int layer) {
        Outline was = is;
        if (middle)
            was.x = from.x, was.y = from.y, middle = false;
        else
            was = before.moved((part++)->outline);
        look(was, is, layer);
    });
    return free;
}

bool Physics::has_room(std::size_t body, const Pose2& pose) const {
    const double far = 1e6;  // nothing was in the way there
    return is_free(body, {pose.x + far, pose.y, pose.yaw}, pose);
}

bool Physics::swing(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts) {
    State& state = states_[body];
    Body& shape = bodies_[body];
    double way = 0;
    for (const auto& [number, outline] : parts)
        way = std::max(way, motion(shape.parts[number].outline, outline));
    const bool free = !state.present || has_room_for(body, way);
    if (!free)
        for (const auto& [number, outline] : parts)
            if (fixed_in_the_way(body, shape.parts[number], outline, shape.parts[number].layer)) return false;

    // The parts go where they are to be; what then overlaps them is pushed out, or all is undone.
    unswung_.clear(), pushed_.clear(), standing_[body].known = false;
    for (const auto& [number, outline] : parts) {
        Outline& part = shape.parts[number].outline;
        unswung_.push_back(part);
        part = outline;
    }
    bool possible = true;
    for (std::size_t thing = 0; !free && possible && thing < states_.size(); ++thing) {
        State& other = states_[thing];
        if (bodies_[thing].driven || !other.present) continue;
        const double near = state.reach + other.reach + 0.01;
        if (std::hypot(other.pose.x - state.pose.x, other.pose.y - state.pose.y) > near) continue;
        const Pose2 from = other.pose;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const Outline is = moved(parts[i].second, state.pose), was = moved(unswung_[i], state.pose);
            const int layer = shape.parts[parts[i].first].layer;
            Overlap deepest;
            each_shape(thing, other.pose, [&](const Outline& o, int there) {
                if (!meet(LayerMask{1} << layer, there)) return;
                const Overlap in = overlap(is, o);
                if (in.depth > tolerance && in.depth > overlap(was, o).depth && in.depth > deepest.depth)
                    deepest = in;
            });
            other.pose.x += deepest.depth * deepest.normal.x();
            other.pose.y += deepest.depth * deepest.normal.y();
        }
        if (other.pose.x == from.x && other.pose.y == from.y) continue;
        possible = is_free(thing, from, other.pose);
        if (possible)
            pushed_.emplace_back(thing, from);
        else
            other.pose = from;
    }
    if (!possible) {
        for (const auto& [thing, from] : pushed_) states_[thing].pose = from;
        for (std::size_t i = 0; i < parts.size(); ++i) shape.parts[parts[i].first].outline = unswung_[i];
        return false;
    }
    const double reach_before = state.reach;
    grow(body);
    if (state.reach > reach_before || !pushed_.empty())
        for (State& s : states_) s.room = 0;
    state.room -= way;
    if (engine_) engine_->reshape(body, shape.parts);
    return true;
}

/// Where the parts are; the rest of them is constant.
void Physics::checkpoint_parts(std::size_t body, Archive& archive) {
    auto& parts = bodies_[body].parts;
    for (Part& p : parts) archive(p.outline.x, p.outline.y, p.outline.cos_yaw, p.outline.sin_yaw);
    standing_[body].known = false;
    if (archive.loading() && engine_ && !parts.empty()) engine_->reshape(body, parts);
}

}  // namespace forage::bug
