// The motion of rigid bodies in the plane: they drive, slide along walls, stop at each other and push
// movable objects.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bug_interface/motion/body.h"
#include "bug_interface/motion/motor.h"
#include "bug_interface/sensing/grid.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

class BulletWorld;

/// Moves bodies in time steps. In every step each driven body gets the velocity of its command; contacts and
/// friction reduce the velocities; then x += v cos(yaw) dt, y += v sin(yaw) dt, yaw += w dt, with the yaw at
/// the start of the step.
///
/// Bodies that may meet each other within some steps form an island; islands cannot touch each other in these
/// steps, so each is simulated by itself (islands.cpp). Where nothing is near, many steps are one stride, and
/// where bodies touch, a few; the strides of an island depend on nothing outside it.
///
/// Bullet finds and solves all contacts of a stride together (bullet_world.h). Collisions have no
/// restitution. No contact outlives a stride; only movable objects keep their velocity.
///
/// After a stride no two shapes penetrate each other by more than 0.8 mm, or by more than before it if that
/// was deeper: a stride that ends otherwise is made again in two halves (contacts.cpp).
class Physics {
  public:
    /// Whether steps are made together where that is exact enough. With `single`, each is made by itself and
    /// contacts are looked for everywhere: the reference for tests.
    enum class Stepping { strides, single };

    /// `step` is the duration of a time step, s. `collision_masks[i]` are the layers that collide with layer
    /// i; when it is empty, all layers collide with each other.
    Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
            Stepping stepping = Stepping::strides, std::vector<LayerMask> collision_masks = {});
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    const Pose2& pose(std::size_t body) const { return states_[body].pose; }  ///< m; yaw in (-pi, pi]
    /// Puts a body at `pose`, at rest.
    void place(std::size_t body, const Pose2& pose);
    /// Removes a body from the world: it touches nothing and does not move until it is placed again.
    void remove(std::size_t body);
    bool present(std::size_t body) const { return states_[body].present; }

    // ---- several steps at once: begin(), then each island by itself ----
    /// Divides the present bodies into islands for the next `steps` steps. `reach[i]` is that of body i per
    /// step; those of movable objects are ignored.
    void begin(std::span<const Reach> reach, std::uint64_t steps);
    std::size_t islands() const { return islands_.size(); }
    std::span<const std::size_t> island(std::size_t i) const {
        return std::span(members_).subspan(islands_[i].first, islands_[i].count);
    }
    /// Whether an island is one body that is certain to touch nothing in these steps.
    bool is_free(std::size_t island) const { return islands_[island].free; }
    /// Moves the body of a free island through all steps: a driven one to `pose`, with `velocity` in the end;
    /// a movable object coasts.
    void move_freely(std::size_t island, const Pose2& pose = {}, const Velocity& velocity = {});
    /// The number of steps that the island should be simulated together next: at least 1, at most `left`.
    std::uint64_t stride(std::size_t island, std::uint64_t left);
    /// Simulates `steps` steps of an island at once. `velocities[i]` is the mean velocity of driven body i in
    /// them if it touches nothing; those of movable objects are ignored.
    void advance(std::size_t island, std::span<const Velocity> velocities, std::uint64_t steps);

    /// The velocity of a driven body at the start of a step.
    Velocity velocity_of(std::size_t body, const MotorCommand& command) {
        State& s = states_[body];
        s.update_rotation();
        return {command.forward * s.cos_yaw, command.forward * s.sin_yaw, command.turn};
    }

    /// Moves parts of a body within its frame: pairs of a part's number and its new outline. Movable objects
    /// in the way are pushed. It must be called after begin(), within the body's Reach. Returns false, and
    /// changes nothing, when an obstacle, a robot or an object that cannot be pushed blocks the motion.
    bool rotate_parts(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts);

    /// Whether a body could be placed at `pose` without an overlap with any other shape.
    bool is_collision_free(std::size_t body, const Pose2& pose) const;

    /// The number of contacts between shapes of this movable object and shapes of robots, summed over the
    /// steps since begin().
    int robot_contacts(std::size_t body) const { return states_[body].robot_contacts; }
    /// Makes the following steps note which driven bodies touch another shape.
    void note_touches() { touched_.resize(bodies_.size()); }
    /// Whether a driven body has touched another shape since forget_touches(). False without note_touches().
    bool touched(std::size_t body) const { return !touched_.empty() && touched_[body]; }
    void forget_touches() { std::fill(touched_.begin(), touched_.end(), 0); }
    double speed(std::size_t body) const;              ///< speed in the last step, m/s
    double angular_velocity(std::size_t body) const {  ///< angular velocity in the last step, rad/s
        return velocities_[body].turn;
    }
    std::span<const Part> parts(std::size_t body) const { return bodies_[body].parts; }

    std::uint64_t contact_steps() const { return contact_steps_; }  ///< number of strides with contacts near

    /// Reads or writes the poses, clearances and velocities. Contacts keep no state that matters.
    void checkpoint(Archive& archive);

  private:
    struct State {
        Pose2 pose;
        bool present = false;
        bool active = false;    ///< whether contacts of the body are possible in this stride
        bool touching = false;  ///< whether they were in the last one
        double obstacle_clearance =
            0;                       ///< how far every point of it can move without touching an obstacle, m
        double body_clearance = 0;   ///< the same for bodies of its island, if none moves more than its own
        bool measured = false;       ///< whether the clearances were measured at this pose
        double displacement = 0;     ///< largest displacement of any point in the current steps so far, m
        double bounding_radius = 0;  ///< radius of what the body has ever covered, in its frame, m
        LayerMask layers = 0;        ///< layers of the central disc and the parts
        int robot_contacts = 0;      ///< in the current steps
        int contacts_in_stride = 0;  ///< the same, in one step of the current stride
        double cached_yaw = 0, cos_yaw = 1, sin_yaw = 0;
        void update_rotation() {
            if (cached_yaw == pose.yaw) return;
            cached_yaw = pose.yaw, cos_yaw = std::cos(cached_yaw), sin_yaw = std::sin(cached_yaw);
        }
        double clearance() const { return std::min(obstacle_clearance, body_clearance); }
        void moved(double distance) {
            measured = false;
            obstacle_clearance -= distance, body_clearance -= distance, displacement += distance;
        }
    };
    struct Island {
        std::size_t first = 0, count = 0;  ///< in members_
        bool free = false;
    };
    /// A shape of a body or an obstacle in world coordinates.
    struct PlacedShape {
        Outline outline;
        std::size_t index = 0;  ///< in its body
        int layer = 0;
        double bounding_radius = 0;  ///< m
        double friction = 0;
    };
    /// The shapes of a body in world coordinates when the body is at `pose`.
    struct ShapeCache {
        std::vector<PlacedShape> shapes;
        Pose2 pose;
        bool valid = false;
    };
    static constexpr double near_distance = 0.001;  ///< m; well above the errors of Bullet's single precision

    void coast(std::size_t body, std::uint64_t steps, Velocity& mean, Velocity& end) const;
    void move(std::size_t body, Velocity mean, double seconds);
    bool make_stride(std::span<const std::size_t> members, std::span<const Velocity> velocities,
                     std::uint64_t steps);
    void update_bounding_radius(std::size_t body);
    void checkpoint_parts(std::size_t body, Archive& archive);
    bool can_collide(LayerMask layers, int layer) const {
        return layers & collision_masks_[static_cast<std::size_t>(layer)];
    }
    // ---- islands ----
    double circle_gap(std::size_t a, std::size_t b) const;
    double shape_gap(std::size_t a, std::size_t b, double limit);
    double lever_arm(std::size_t body) const;
    double max_displacement(std::size_t body, double travel, double turn) const;
    double max_displacement(std::size_t body, const Velocity& v, double seconds) const {
        return max_displacement(body, std::hypot(v.x, v.y) * seconds, std::abs(v.turn) * seconds);
    }
    double displacement_per_step(std::size_t body) const;
    bool may_touch_something(std::size_t body, double displacement);
    void measure_clearance(std::size_t body);
    void find_pairs();
    std::size_t find_root(std::size_t body);
    void activate_neighbours(std::span<const std::size_t> bodies, double seconds);
    const std::vector<PlacedShape>& shapes(std::size_t body);
    template <class F>
    void for_each_obstacle_near(std::size_t body, double reach, F&& visit) const {
        const State& s = states_[body];
        obstacle_grid_.visit(Area::around(s.pose.x, s.pose.y, s.bounding_radius + reach), [&](std::size_t o) {
            if (obstacles_[o].layers & s.layers) visit(obstacles_[o], o);
        });
    }
    // ---- contacts ----
    void solve_contacts(std::span<const std::size_t> bodies, std::uint64_t steps);
    void add_contacts(std::size_t a, const PlacedShape& of_a, std::size_t b, const PlacedShape& of_b,
                      double within);
    bool penetrates(std::size_t a, std::size_t b);
    template <class F>
    void for_each_penetration(std::span<const std::size_t> bodies, F&& visit);
    bool undo_penetrations(std::span<const std::size_t> bodies, std::uint64_t steps);
    /// Calls visit(shape, obstacle) for the shapes of a body that can collide with obstacles which may be
    /// closer than `reach` (m).
    template <class F>
    void for_each_obstacle_pair(std::size_t body, double reach, F&& visit) {
        for_each_obstacle_near(body, reach, [&](const Obstacle& o, std::size_t number) {
            const PlacedShape& obstacle = obstacle_shapes_[number];
            for (const PlacedShape& p : shapes(body))
                if (o.layers >> p.layer & 1u &&
                    closer_than(p.outline, o.outline, reach + p.bounding_radius + obstacle.bounding_radius))
                    visit(p, obstacle);
        });
    }
    /// The same for the shapes of two bodies.
    template <class F>
    void for_each_pair(std::size_t a, std::size_t b, double reach, F&& visit) {
        if (circle_gap(a, b) >= reach) return;
        for (const PlacedShape& p : shapes(a))
            for (const PlacedShape& q : shapes(b))
                if (can_collide(LayerMask{1} << p.layer, q.layer) &&
                    closer_than(p.outline, q.outline, reach + p.bounding_radius + q.bounding_radius))
                    visit(p, q);
    }
    // ---- rotation of parts ----
    bool is_blocked(std::size_t body, const Part& part, const Outline& target) const;
    bool can_move(std::size_t body, const Pose2& from, const Pose2& to) const;
    bool push_objects(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts);
    /// Calls visit(outline in world coordinates, layer, friction) for the central disc and the parts of a
    /// body at `pose`.
    template <class F>
    void for_each_shape(std::size_t body, const Pose2& pose, F&& visit) const {
        for_each_shape(body, Transform2(pose), std::forward<F>(visit));
    }
    template <class F>
    void for_each_shape(std::size_t body, const Transform2& pose, F&& visit) const {
        const Body& b = bodies_[body];
        if (b.radius > 0) {
            Outline disc;
            disc.round = true, disc.x = pose.x(), disc.y = pose.y(), disc.radius = b.radius;
            visit(disc, b.layer, b.friction);
        }
        for (const Part& part : b.parts) visit(pose * part.outline, part.layer, part.friction);
    }

    Outline outline(std::size_t body, std::size_t index, const Pose2& pose) const;

    std::vector<Obstacle> obstacles_;
    std::vector<PlacedShape> obstacle_shapes_;
    Grid obstacle_grid_;
    std::vector<Body> bodies_;
    std::vector<State> states_;
    std::vector<Velocity> velocities_;
    std::vector<ShapeCache> shape_caches_;
    double step_;  ///< s
    Stepping stepping_;
    std::vector<LayerMask> collision_masks_;
    std::vector<char> touched_;  ///< one per body; empty when touches are not noted
    std::uint64_t contact_steps_ = 0;
    double heaviest_ = 0;  ///< mass of the heaviest driven body, kg

    // ---- the current steps, from begin() on ----
    std::uint64_t steps_ = 1;   ///< their number
    std::vector<Reach> reach_;  ///< per body and step
    double push_ = 0;           ///< how far any body may move in all steps, m
    std::vector<Area> areas_;   ///< what each body may cover
    Grid body_grid_;
    std::vector<std::vector<std::size_t>> near_;  ///< per body: the bodies that it may meet
    std::vector<std::size_t> root_;     ///< per body: another one of its island, in the end the first
    std::vector<std::size_t> members_;  ///< the present bodies, island by island
    std::vector<Island> islands_;
    std::vector<Velocity> undisturbed_, coasting_;  ///< per movable object: if nothing touches it, its mean
                                                    ///< velocity in the stride, and the one after it
    std::vector<std::size_t> active_;               ///< the active bodies of the island
    std::vector<Eigen::Vector2d> corrections_;      ///< per body: moves it out of what it penetrates, m
    std::vector<State> states_before_;              ///< before the current stride
    std::vector<Velocity> velocities_before_;
    std::vector<Outline> outlines_before_;               ///< outlines of parts before rotate_parts()
    std::vector<std::pair<std::size_t, Pose2>> pushed_;  ///< bodies that parts pushed, with the poses before
    std::unique_ptr<BulletWorld> bullet_;
};

}  // namespace forage::bug
