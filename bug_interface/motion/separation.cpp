// No step ends with shapes deeper in each other than 0.8 mm, or than they were when it began.
//
// Bullet solves velocities. It tells of two boxes only once they overlap, and its solution is approximate
// where a body is squeezed from several sides. What a step got too deep into each other is moved apart here;
// who cannot be freed stays where the step began.
#include <algorithm>
#include <cmath>

#include "bug_interface/motion/overlap.h"
#include "bug_interface/motion/physics.h"

namespace forage::bug {
namespace {

constexpr double depth_left = 5e-4;       ///< m that shapes may stay in each other
constexpr double depth_tolerated = 8e-4;  ///< m, where all moves left more than that
constexpr double depth_noticed = 1e-12;   ///< m more that are worth a move
constexpr int most_rounds = 20;           ///< of moves, pair by pair

double square(double v) { return v * v; }
/// Whether circles round two outlines, which reach so far together, touch.
bool may_touch(const Outline& a, const Outline& b, double reaches) {
    return square(b.x - a.x) + square(b.y - a.y) < square(reaches);
}

}  // namespace

/// Calls visit(a, shape of a, b, shape of b, how deep they are in each other) for shapes that are deeper in
/// each other than half a millimetre, where a or b is involved. For an obstacle, b is the number of bodies
/// and its shape the number of the obstacle.
template <class F>
void Physics::each_overlap(F&& visit) {
    const auto look = [&](std::size_t a, std::size_t p, const Placed& here, const Outline& there,
                          double reach_there, std::size_t b, std::size_t q) {
        if (!may_touch(there, here.outline, reach_there + here.reach)) return;
        const Overlap in = overlap(there, here.outline, depth_left);
        if (in.depth <= depth_left + depth_noticed) return;
        visit(a, p, b, q, in);
        shapes(a);  // where they are now
        if (b < bodies_.size()) shapes(b);
    };
    for (std::size_t a = 0; a < states_.size(); ++a) {
        const State& s = states_[a];
        if (!s.present) continue;
        for (std::size_t o = 0; s.involved && o < obstacles_.size(); ++o) {
            const Outline& there = obstacles_[o].outline;
            if (!(obstacles_[o].layers & s.layers)) continue;
            const double reach_there = reach(there);
            if (square(there.x - s.pose.x) + square(there.y - s.pose.y) >= square(reach_there + s.reach))
                continue;
            const auto& here = shapes(a);
            for (std::size_t p = 0; p < here.size(); ++p)
                if (obstacles_[o].layers >> here[p].layer & 1u)
                    look(a, p, here[p], there, reach_there, bodies_.size(), o);
        }
        for (std::size_t b = 0; b < a; ++b) {
            const State& other = states_[b];
            if (!other.present || !(s.involved || other.involved) || apart(a, b) >= 0) continue;
            const auto &here = shapes(a), &there = shapes(b);
            for (std::size_t p = 0; p < here.size(); ++p)
                for (std::size_t q = 0; q < there.size(); ++q)
                    if (meet(LayerMask{1} << here[p].layer, there[q].layer))
                        look(a, p, here[p], there[q].outline, there[q].reach, b, q);
        }
    }
}

/// How deep two shapes were in each other when the step began, m.
double Physics::depth_before(std::size_t a, std::size_t p, std::size_t b, std::size_t q) const {
    const auto began = [&](std::size_t body, std::size_t shape) {
        const Body& what = bodies_[body];
        const bool middle = what.radius > 0;
        if (!middle || shape > 0) return moved(what.parts[shape - (middle ? 1 : 0)].outline, began_[body]);
        Outline outline = standing_[body].shapes[shape].outline;
        outline.x = began_[body].x, outline.y = began_[body].y;
        return outline;
    };
    const Outline there = b < bodies_.size() ? began(b, q) : obstacles_[q].outline;
    return overlap(there, began(a, p)).depth;
}

void Physics::shift(std::size_t body, double x, double y) {
    State& s = states_[body];
    s.pose.x += x, s.pose.y += y;
    s.involved = true;  // it may be one that nobody could reach by the velocities before they were solved
    s.room -= std::sqrt(x * x + y * y);
}

/// Two that both stayed where they were are left alone: some are placed in each other.
void Physics::separate() {
    const auto stayed = [&](std::size_t i) {
        if (i == bodies_.size()) return true;
        const Pose2 &now = states_[i].pose, &before = began_[i];
        return now.x == before.x && now.y == before.y && now.yaw == before.yaw;
    };
    for (int round = 0; round < most_rounds; ++round) {
        bool moved = false;
        each_overlap([&](std::size_t a, std::size_t p, std::size_t b, std::size_t q, const Overlap& in) {
            if (stayed(a) && stayed(b)) return;
            const double before = depth_before(a, p, b, q);
            const double deeper = in.depth - (before > depth_tolerated ? before : depth_left);
            if (deeper <= depth_noticed) return;
            moved = true;
            const double share = b < bodies_.size() ? deeper / 2 : deeper;
            shift(a, share * in.normal.x(), share * in.normal.y());
            if (b < bodies_.size()) shift(b, -share * in.normal.x(), -share * in.normal.y());
        });
        if (!moved) return;
    }
    take_back();
}

/// Where a step began nothing was deeper in anything than it may be: who is goes back there, at rest, and so
/// does who is in the way of that.
void Physics::take_back() {
    stays_.assign(states_.size(), 0);
    for (bool more = true; more;) {
        more = false;
        const auto stay = [&](std::size_t i) {
            if (i == bodies_.size() || stays_[i]) return;
            stays_[i] = more = true;
            states_[i].pose = began_[i], states_[i].involved = true;
            velocities_[i] = {};
        };
        each_overlap([&](std::size_t a, std::size_t p, std::size_t b, std::size_t q, const Overlap& in) {
            if (in.depth > depth_noticed + std::max(depth_tolerated, depth_before(a, p, b, q)))
                stay(a), stay(b);
        });
    }
}

}  // namespace forage::bug
