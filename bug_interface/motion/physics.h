// Bodies that drive over a plane, slide along walls, stop at each other and push what is loose.
#pragma once

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

/// Things touch only where they share heights. Heights come in at most 32 layers; a mask has a bit for each.
using LayerMask = std::uint32_t;
inline constexpr std::size_t most_layers = 32;

/// Something that stands in the way and never moves, seen from above.
struct Obstacle {
    Outline outline;
    double friction = 1;     ///< Coulomb coefficient; of a contact it is the smaller one of the two surfaces
    LayerMask layers = ~0u;  ///< those that it reaches into
};

/// A part of a body, in the body's frame.
struct Part {
    Outline outline;
    int layer = 0;
    double friction = 0.1;
};

/// Something that moves: a robot, which is driven, or a loose thing, which keeps its velocity until contacts
/// and the floor change it.
struct Body {
    double radius = 0.2;    ///< of its round middle, m; 0: it has none
    double mass = 5;        ///< kg
    double inertia = 1;     ///< about the vertical axis, kg m^2
    double friction = 0.1;  ///< Coulomb coefficient, of the middle
    int layer = 0;          ///< of the middle
    std::vector<Part> parts;
    bool driven = true;
    double slowing = 0;       ///< by the floor, of a loose thing, m/s^2
    double slowing_turn = 0;  ///< rad/s^2
};

/// Moves bodies in steps. In every step each driven body is given its velocity anew, contacts take away what
/// would lead into an obstacle or another body, friction takes its share, and the rest moves the body: x += v
/// cos(yaw) dt, y += v sin(yaw) dt, yaw += w dt, with the yaw from the start of the step. What then is too
/// deep in something is moved out of it.
///
/// Contacts are resolved by Bullet, and only in steps in which some body could touch something, among the
/// bodies that could (nearness.cpp). Far from everything Bullet would change nothing and is not called: both
/// ways give the same bits. There is no restitution, and nothing of a contact lasts longer than its step,
/// except the velocity of loose things.
///
/// No step ends with shapes deeper in each other than 0.8 mm, or than they were when it began
/// (separation.cpp).
class Physics {
  public:
    /// When Bullet is called. `always` is for tests and benchmarks.
    enum class Contacts { when_near, always };

    /// `step`: duration of a step, s. `meets[i]`: the layers that share heights with layer i; all do when
    /// empty.
    Physics(std::span<const Obstacle> obstacles, std::span<const Body> bodies, double step,
            Contacts contacts = Contacts::when_near, std::vector<LayerMask> meets = {});
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    const Pose2& pose(std::size_t body) const { return states_[body].pose; }  ///< m; yaw in (-pi, pi]
    /// Puts a body somewhere, at rest.
    void place(std::size_t body, const Pose2& pose);
    /// Takes a body out of the world: it touches nothing and does not move until it is placed again.
    void lift(std::size_t body);
    bool present(std::size_t body) const { return states_[body].present; }

    /// One step; `drives[i]` is what body i is driven with. Loose things need none.
    void step(std::span<const MotorCommand> drives);

    /// Whether a driven body is sure to touch nothing while it drives so far (m) and turns by so much (rad),
    /// if all others do no more than that either: they have room of their own. Never while something loose
    /// moves.
    bool can_drive_freely(std::size_t body, double travel, double turn);
    /// Several steps of a body that is free for them, at once: it is now at `pose`, driven with `drive`.
    void drive_freely(std::size_t body, const Pose2& pose, const MotorCommand& drive, double travel,
                      double turn);

    /// Moves parts of a body within its frame (numbers of its parts, and where they are to be), unless they
    /// would get into something that cannot give way. Loose things in the way are pushed. Returns whether it
    /// was done.
    bool swing(std::size_t body, std::span<const std::pair<std::size_t, Outline>> parts);

    /// Whether a body that is not there could be placed at `pose` without overlapping anything.
    bool has_room(std::size_t body, const Pose2& pose) const;

    /// How many pairs of shapes of this loose thing and a driven body touched in the last step.
    int touches(std::size_t body) const { return states_[body].touches; }
    double speed(std::size_t body) const;                                      ///< m/s, in the last step
    double turning(std::size_t body) const { return velocities_[body].turn; }  ///< rad/s, in the last step
    std::span<const Part> parts(std::size_t body) const { return bodies_[body].parts; }

    std::uint64_t contact_steps() const { return contact_steps_; }  ///< how often Bullet was called

    /// Where everything is. Bullet's own memory is no part of it: no step depends on it.
    void checkpoint(Archive& archive) {
        for (State& s : states_) archive(s.pose, s.present, s.room, s.reach, s.layers, s.touches);
        for (Velocity& v : velocities_) archive(v.x, v.y, v.turn);
        archive(contact_steps_);
        for (std::size_t i = 0; i < bodies_.size(); ++i) checkpoint_parts(i, archive);
    }

  private:
    struct State {
        Pose2 pose;
        bool present = false;
        bool involved = false;  ///< in this step, with what Bullet has to look at
        double room = 0;        ///< m that all its points can move for sure before one touches anything
        double reach = 0;       ///< radius of a circle round all that it ever was, m
        LayerMask layers = 0;   ///< of its middle and parts
        int touches = 0;
        double facing = 0, cos_yaw = 1, sin_yaw = 0;  ///< a yaw, and of that
        /// Makes them those of the pose.
        void face() {
            if (facing == pose.yaw) return;
            facing = pose.yaw, cos_yaw = std::cos(facing), sin_yaw = std::sin(facing);
        }
    };
    struct Velocity {
        double x = 0, y = 0, turn = 0;  ///< m/s, m/s, rad/s
    };
    static bool rests(const Velocity& v) { return v.x == 0 && v.y == 0 && v.turn == 0; }
    /// A shape of a body where it is in the world.
    struct Placed {
        Outline outline;
        int layer = 0;
        double reach = 0;  ///< radius of a circle round it, m
    };
    /// The shapes of a body as they were placed last.
    struct Standing {
        std::vector<Placed> shapes;
        Pose2 at;
        bool known = false;  ///< whether they are those that it has, at that pose
    };
    class Engine;  ///< Bullet's side

    void drive(std::size_t body, const MotorCommand& command);
    // ---- who is near what ----
    double apart(std::size_t a, std::size_t b) const;
    double lever(std::size_t body) const;
    double way(std::size_t body, double travel, double turn) const;
    bool near_something(std::size_t body, double way);
    bool has_room_for(std::size_t body, double way);
    void checkpoint_parts(std::size_t body, Archive& archive);
    void measure_room(std::size_t body);
    const std::vector<Placed>& shapes(std::size_t body);
    double gap_between(std::size_t body, std::size_t other);
    bool may_be_nearer(std::size_t body, std::size_t other, double than);
    void involve_neighbours();
    // ---- who got too deep into what ----
    template <class F>
    void each_overlap(F&& visit);
    double depth_before(std::size_t a, std::size_t p, std::size_t b, std::size_t q) const;
    void shift(std::size_t body, double x, double y);
    void separate();
    void take_back();
    // ---- what swings ----
    void grow(std::size_t body);
    bool meet(LayerMask layers, int layer) const { return layers & meets_[static_cast<std::size_t>(layer)]; }
    bool fixed_in_the_way(std::size_t body, const Part& now, const Outline& then, int layer) const;
    bool is_free(std::size_t thing, const Pose2& from, const Pose2& to) const;
    /// Calls visit(outline in the world, layer) for the middle and the parts of a body at `pose`.
    template <class F>
    void each_shape(std::size_t body, const Pose2& pose, F&& visit) const {
        each_shape(body, Frame(pose), std::forward<F>(visit));
    }
    template <class F>
    void each_shape(std::size_t body, const Frame& frame, F&& visit) const {
        const Body& b = bodies_[body];
        if (b.radius > 0) {
            Outline middle;
            middle.round = true, middle.x = frame.x(), middle.y = frame.y(), middle.radius = b.radius;
            visit(middle, b.layer);
        }
        for (const Part& part : b.parts) visit(frame.moved(part.outline), part.layer);
    }

    std::vector<Obstacle> obstacles_;
    std::vector<Body> bodies_;
    std::vector<State> states_;
    std::vector<Velocity> velocities_;  ///< of this step
    std::vector<Standing> standing_;
    double step_;
    Contacts contacts_;
    std::vector<LayerMask> meets_;
    std::uint64_t contact_steps_ = 0;
    std::vector<Pose2> began_;                           ///< where bodies were before a step
    std::vector<char> stays_;                            ///< whether a body is taken back
    std::vector<Outline> unswung_;                       ///< parts that swing, as they were
    std::vector<std::pair<std::size_t, Pose2>> pushed_;  ///< by them, and from where
    std::unique_ptr<Engine> engine_;
};

}  // namespace forage::bug
