// Rigid bodies in the plane: they drive, slide along walls, stop at each other and push movable objects.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bug_interface/motion/motor.h"
#include "bug_interface/motion/overlap.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// Shapes collide only when they share heights. Heights are divided into at most max_layers layers; a mask
/// has one bit per layer.
using LayerMask = std::uint32_t;
inline constexpr std::size_t max_layers = 32;

/// A shape that never moves, seen from above.
struct Obstacle {
    Outline outline;
    double friction = 1;     ///< Coulomb coefficient; a contact has the smaller one of its two surfaces
    LayerMask layers = ~0u;  ///< the layers that the shape extends into
};

/// A shape of a body beside its central disc, in the frame of the body.
struct Part {
    Outline outline;
    int layer = 0;
    double friction = 0.1;  ///< Coulomb coefficient
};

/// A robot, which is driven, or a movable object, which keeps its velocity until contacts or the friction of
/// the floor change it.
struct Body {
    double radius = 0.2;    ///< radius of the central disc, m; 0 for a body without one
    double mass = 5;        ///< kg
    double inertia = 1;     ///< about the vertical axis, kg m^2
    double friction = 0.1;  ///< Coulomb coefficient of the central disc
    int layer = 0;          ///< layer of the central disc
    std::vector<Part> parts;
    bool driven = true;               ///< false for a movable object
    double deceleration = 0;          ///< deceleration of a movable object on the floor, m/s^2
    double angular_deceleration = 0;  ///< the same for its rotation, rad/s^2
};

/// Moves bodies in time steps. In every step each driven body gets the velocity of its command; contacts and
/// friction reduce the velocities; then x += v cos(yaw) dt, y += v sin(yaw) dt, yaw += w dt, with the yaw at
/// the start of the step. Shapes that penetrate each other afterwards are separated.
///
/// Bullet resolves the contacts. It is called only in steps in which a contact is possible, and only for the
/// bodies that may take part (broadphase.cpp); the result has the same bits as if it were called in every
/// step. Collisions have no restitution. Contacts do not persist from step to step; only movable objects keep
/// their velocity.
///
/// After a step no two shapes penetrate each other by more than 0.8 mm, or by more than before the step if
/// that was deeper (separation.cpp).
class Physics {
  public:
    /// When Bullet is called. `always` is for tests and benchmarks.
    enum class Contacts { when_near, always };

    /// `step` is the duration of a time step, s. `collision_masks[i]` are the layers that collide with layer
    /// i; when it is empty, all layers collide with each other.
    Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
            Contacts contacts = Contacts::when_near, std::vector<LayerMask> collision_masks = {});
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    const Pose2& pose(std::size_t body) const { return states_[body].pose; }  ///< m; yaw in (-pi, pi]
    /// Puts a body at `pose`, at rest.
    void place(std::size_t body, const Pose2& pose);
    /// Removes a body from the world: it touches nothing and does not move until it is placed again.
    void remove(std::size_t body);
    bool present(std::size_t body) const { return states_[body].present; }

    /// Simulates one time step. `commands[i]` drives body i; those of movable objects are ignored.
    void step(std::span<const MotorCommand> commands);

    /// Whether a driven body is certain to touch nothing while it travels `travel` (m) and turns by `turn`
    /// (rad), provided that no other body does more. Always false while a movable object moves.
    bool can_drive_freely(std::size_t body, double travel, double turn);
    /// Replaces several steps of a body for which can_drive_freely() holds: moves it to `pose` with the
    /// velocity of `command`.
    void drive_freely(std::size_t body, const Pose2& pose, const MotorCommand& command, double travel,
                      double turn);

    /// Moves parts of a body within its frame: pairs of a part's number and its new outline. Movable objects
    /// in the way are pushed. Returns false, and changes nothing, when an obstacle, a robot or an object that
    /// cannot be pushed blocks the motion.
    bool rotate_parts(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts);

    /// Whether a body could be placed at `pose` without an overlap with any other shape.
    bool is_collision_free(std::size_t body, const Pose2& pose) const;

    /// The number of contacts between shapes of this movable object and shapes of robots in the last step.
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

    std::uint64_t contact_steps() const { return contact_steps_; }  ///< number of calls of Bullet

    /// Reads or writes the poses and velocities. Bullet keeps no state between steps.
    void checkpoint(Archive& archive) {
        for (State& s : states_)
            archive(s.pose, s.present, s.clearance, s.bounding_radius, s.layers, s.robot_contacts);
        for (Velocity& v : velocities_) archive(v.x, v.y, v.turn);
        archive(contact_steps_);
        for (std::size_t i = 0; i < bodies_.size(); ++i) checkpoint_parts(i, archive);
    }

  private:
    struct State {
        Pose2 pose;
        bool present = false;
        bool active = false;         ///< whether Bullet has to consider the body in this step
        double clearance = 0;        ///< how far every point of the body can move without a contact, m
        double bounding_radius = 0;  ///< radius of what the body has ever covered, in its frame, m
        LayerMask layers = 0;        ///< layers of the central disc and the parts
        int robot_contacts = 0;
        double cached_yaw = 0, cos_yaw = 1, sin_yaw = 0;
        void update_rotation() {
            if (cached_yaw == pose.yaw) return;
            cached_yaw = pose.yaw, cos_yaw = std::cos(cached_yaw), sin_yaw = std::sin(cached_yaw);
        }
    };
    struct Velocity {
        double x = 0, y = 0, turn = 0;  ///< m/s, m/s, rad/s
    };
    static bool is_zero(const Velocity& v) { return v.x == 0 && v.y == 0 && v.turn == 0; }
    /// A shape of a body in world coordinates.
    struct PlacedShape {
        Outline outline;
        int layer = 0;
        double bounding_radius = 0;  ///< m
    };
    /// The shapes of a body in world coordinates when the body is at `pose`.
    struct ShapeCache {
        std::vector<PlacedShape> shapes;
        Pose2 pose;
        bool valid = false;
    };
    class ContactSolver;  ///< calls Bullet

    void set_velocity(std::size_t body, const MotorCommand& command);
    void update_bounding_radius(std::size_t body);
    void checkpoint_parts(std::size_t body, Archive& archive);
    bool can_collide(LayerMask layers, int layer) const {
        return layers & collision_masks_[static_cast<std::size_t>(layer)];
    }
    // ---- broad phase ----
    double circle_gap(std::size_t a, std::size_t b) const;
    double shape_gap(std::size_t a, std::size_t b);
    bool may_be_closer_than(std::size_t a, std::size_t b, double distance);
    double lever_arm(std::size_t body) const;
    double max_displacement(std::size_t body, double travel, double turn) const;
    bool may_touch_something(std::size_t body, double displacement);
    bool has_clearance(std::size_t body, double displacement);
    void measure_clearance(std::size_t body);
    void activate_neighbours();
    const std::vector<PlacedShape>& shapes(std::size_t body);
    // ---- separation ----
    template <class F>
    void for_each_penetration(F&& visit);
    double depth_before_step(std::size_t a, std::size_t p, std::size_t b, std::size_t q) const;
    void translate(std::size_t body, double x, double y);
    void separate();
    void revert_penetrating();
    // ---- rotation of parts ----
    bool is_blocked(std::size_t body, const Part& part, const Outline& target) const;
    bool can_move(std::size_t body, const Pose2& from, const Pose2& to) const;
    bool push_objects(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts);
    /// Calls visit(outline in world coordinates, layer) for the central disc and the parts of a body at
    /// `pose`.
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
            visit(disc, b.layer);
        }
        for (const Part& part : b.parts) visit(pose * part.outline, part.layer);
    }

    std::vector<Obstacle> obstacles_;
    std::vector<Body> bodies_;
    std::vector<State> states_;
    std::vector<Velocity> velocities_;  ///< velocities in the current step
    std::vector<ShapeCache> shape_caches_;
    double step_;  ///< s
    Contacts contacts_;
    std::vector<LayerMask> collision_masks_;
    std::vector<char> touched_;  ///< one per body; empty when touches are not noted
    std::uint64_t contact_steps_ = 0;
    std::vector<Pose2> poses_before_;                    ///< before the current step
    std::vector<char> reverted_;                         ///< whether a body is put back to its pose before
    std::vector<Outline> outlines_before_;               ///< outlines of parts before rotate_parts()
    std::vector<std::pair<std::size_t, Pose2>> pushed_;  ///< bodies that parts pushed, with the poses before
    std::unique_ptr<ContactSolver> contact_solver_;
};

}  // namespace forage::bug
