// Robots that drive over a plane, slide along walls and stop at each other.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bug_interface/motion/motor.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// Something that stands in the way and never moves, seen from above.
struct Obstacle {
    Outline outline;
    double friction = 1;  ///< Coulomb coefficient; of a contact it is the smaller one of the two surfaces
};

/// A round robot.
struct Body {
    double radius = 0.2;    ///< m
    double mass = 5;        ///< kg
    double inertia = 1;     ///< about the vertical axis, kg m^2
    double friction = 0.1;  ///< Coulomb coefficient
};

/// Moves bodies in steps. In every step each body is given its velocity anew, contacts take away what would
/// lead into an obstacle or another body, friction takes its share, and the rest moves the body: x += v
/// cos(yaw) dt, y += v sin(yaw) dt, yaw += w dt, with the yaw from the start of the step.
///
/// Contacts are resolved by Bullet, and only in steps in which some body could touch something. Far from
/// everything Bullet would change nothing and is not called: both ways give the same bits. There is no
/// restitution, no friction with the floor, and nothing of a contact lasts longer than its step.
class Physics {
  public:
    /// When Bullet is called. `always` is for tests and benchmarks.
    enum class Contacts { when_near, always };

    /// `step`: duration of a step, s.
    Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
            Contacts contacts = Contacts::when_near);
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    const Pose2& pose(std::size_t body) const { return states_[body].pose; }  ///< m; yaw in (-pi, pi]
    /// Puts a body somewhere.
    void place(std::size_t body, const Pose2& pose);
    /// Takes a body out of the world: it touches nothing and does not move until it is placed again.
    void lift(std::size_t body);

    /// One step; `drives[i]` is what body i is driven with.
    void step(std::span<const MotorCommand> drives);

    std::uint64_t contact_steps() const { return contact_steps_; }  ///< how often Bullet was called

    /// Where everything is. Bullet's own memory is no part of it: no step depends on it.
    void checkpoint(Archive& archive) {
        for (State& s : states_) archive(s.pose, s.present, s.clearance);
        archive(contact_steps_);
    }

  private:
    struct State {
        Pose2 pose;
        bool present = false;
        double clearance = 0;  ///< m that the body can move for sure before it touches anything
    };
    struct Velocity {
        double x, y, turn;  ///< m/s, m/s, rad/s
    };
    class Engine;  ///< Bullet's side

    bool near_something(std::size_t body, double travel);
    void measure_clearance(std::size_t body);

    std::vector<Obstacle> obstacles_;
    std::vector<Body> bodies_;
    std::vector<State> states_;
    std::vector<Velocity> velocities_;  ///< of this step
    double step_;
    Contacts contacts_;
    std::uint64_t contact_steps_ = 0;
    std::unique_ptr<Engine> engine_;
};

}  // namespace forage::bug
