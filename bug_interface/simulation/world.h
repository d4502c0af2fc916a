// A simulated world that runs in lock-step with a neural system.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "bug_interface/simulation/game.h"
#include "bug_interface/simulation/movable_object.h"
#include "bug_interface/simulation/robot.h"
#include "bug_interface/simulation/surroundings.h"
#include "bug_interface/simulation/trials.h"
#include "bug_interface/simulation/world_queries.h"
#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"
#include "core/run/environment.h"

namespace forage::bug {

struct WorldOptions {
    std::uint64_t seed = 1;
    double cycles_per_second = 25;  ///< cycles of the neural system per second of wall-clock time
    /// Simulated time per wall-clock time. Empty for the factor in the world file.
    std::optional<double> real_time_factor;
    bool noise = true;          ///< whether motors, scanners and cameras are noisy; resets are always random
    bool sensor_rates = false;  ///< whether sensors have the rates of the world file, instead of every cycle
    int latency = 0;            ///< cycles until modules receive what was sensed
    bool game = false;          ///< whether the challenge's game is played in a world without rules
    /// How many steps are made together; all but the default is for tests.
    Physics::Stepping stepping = Physics::Stepping::strides;
    /// Those of another world with the same description, to share; null: the world makes its own.
    std::shared_ptr<Surroundings> surroundings = nullptr;
};

/// A world with robots and movable objects. A robot is a model with a link named "bug" and the velocity
/// plugin. A robot with the reset plugin is reset to a start pose when it leaves the bounds or the world's
/// rules say so, which ends a trial. All other models that are not static are movable objects: robots can
/// push and carry them. Robots are numbered from 0 in the order of the file.
///
/// In each cycle the neural system runs first: its module reads the snapshots and gives commands. Then step()
/// is called. The result depends only on the description, the options and the commands. Each robot and each
/// use of random numbers (motor noise, each scanner, camera, reset) has its own random stream, so that
/// turning one off does not change the others. A World must not be used by two threads at the same time.
class World final : public Environment {
  public:
    /// Returns null when the world cannot be simulated; `diagnostics` then has the reason.
    static std::unique_ptr<World> make(const WorldDescription& description, const WorldOptions& options,
                                       Diagnostics& diagnostics);

    // ---- time ----
    /// The mean simulated time per cycle, s.
    double seconds_per_cycle() const override { return substeps_per_cycle_ * description_.step; }
    double time() const { return static_cast<double>(substep_) * description_.step; }  ///< simulated time, s
    std::uint64_t cycle() const { return cycle_; }       ///< number of finished cycles
    std::uint64_t substeps() const { return substep_; }  ///< number of finished physics steps

    std::unique_ptr<Environment> restarted(std::uint64_t seed) const override;
    /// Simulates one cycle: the motion, then the snapshots of all robots. The first snapshots are taken by
    /// make().
    void step() override;
    // The three parts of step(), for benchmarks. They must be called in this order.
    void advance_bodies();  ///< simulates the substeps of a cycle
    void scan();            ///< writes poses and range scans into the snapshots
    void render();          ///< writes the requested images into the snapshots

    /// Reads or writes all state, between two cycles. The state must be read into a world with the same
    /// description and options that the same modules use. Throws ArchiveError when it does not fit.
    void checkpoint(Archive& archive) override;

    // ---- for modules ----
    std::size_t bugs() const { return robots_.size(); }
    std::vector<std::string> robot_names() const override;
    std::optional<std::size_t> find(std::string_view bug) const;
    /// Claims a robot for one module, until the returned object is destroyed. Null when the robot is claimed.
    std::shared_ptr<void> claim(std::size_t bug);
    /// Sets the velocity command of a robot, which holds until the next call. Before the first call the robot
    /// stands still.
    void command(std::size_t bug, const MotorCommand& command) { robots_[bug].command = command; }
    /// Closes or opens the gripper, until the next call. It closes only after it has been opened once.
    void grip(std::size_t bug, bool close) { robots_[bug].hinges.command(close); }
    /// Ends the trial of a robot at once and begins the next, between two cycles: at `start`, or at the next
    /// start pose. A robot that is never reset begins where its first trial began. The robot stands until the
    /// next command, and its sensors see where it is at the end of the next cycle.
    void begin_trial(std::size_t bug, const std::optional<Pose2>& start = {});
    /// Moves a robot or a movable object to `pose` between two cycles; it is at rest there, and a trial goes
    /// on. The sensors see it at the end of the next cycle. Returns false, and changes nothing, when it would
    /// overlap something there, and while the robot is being reset.
    bool move_robot(std::size_t bug, const Pose2& pose);
    bool move_object(std::size_t object, const Pose2& pose);
    /// The first of these robots that would overlap something if all of them were at these poses. Changes
    /// nothing.
    std::optional<std::size_t> first_blocked(std::span<const std::pair<std::size_t, Pose2>> robots);
    bool has_gripper(std::size_t bug) const { return !robots_[bug].hinges.empty(); }
    /// The angle of a hinge of the gripper, rad.
    double gripper_angle(std::size_t bug, std::size_t hinge) const {
        return robots_[bug].hinges[hinge].angle;
    }
    /// Transmits `cells` to all robots with the same key, which receive them in the next cycle. Called once
    /// per cycle.
    void transmit(std::size_t bug, std::string_view key, std::span<const double> cells) {
        robots_[bug].transceiver.transmit(key, cells, robots_[bug].sensors.snapshot().pose);
    }
    /// The snapshot that modules receive: that of the last cycle, or of an earlier cycle when there is a
    /// latency.
    const BugSnapshot& snapshot(std::size_t bug) const { return robots_[bug].sensors.delayed(cycle_); }
    /// Requests that the snapshots of a robot have the gripper's scan, or an image.
    void request_gripper_scan(std::size_t bug, bool requested);
    void request_image(std::size_t bug, bool requested);

    // ---- for observers ----
    Pose2 pose(std::size_t bug) const override { return robots_[bug].pose; }
    bool driven(std::size_t bug) const override { return !robots_[bug].claim.expired(); }
    /// The point of the floor (z = 0) in the centre of the camera's image, in world coordinates, m. The
    /// position of the robot when it has no camera that looks down.
    Eigen::Vector2d looks_at(std::size_t bug) const;
    /// The camera's image at the end of the last cycle, whatever modules request, without latency. Empty
    /// without a camera; valid until the next call for this robot. Throws std::runtime_error when the picture
    /// of a floor cannot be read.
    std::span<const std::uint8_t> image(std::size_t bug);

    bool has_trials(std::size_t bug) const override {
        return bug < robots_.size() && robots_[bug].reset.has_value();
    }
    bool resetting(std::size_t bug) const override {
        return robots_[bug].reset && robots_[bug].reset->running();
    }
    const std::vector<Trial>& trials(std::size_t bug) const override {
        return robots_[bug].trials->finished();
    }
    Trial current_trial(std::size_t bug) const override;
    /// Whether a trial that reached a target ended in the last cycle.
    bool just_reached(std::size_t bug) const;
    std::vector<Pose2> start_poses() const override { return plan_ ? plan_->starts : std::vector<Pose2>(); }
    bool has_targets() const override { return !targets_.empty(); }
    double target_distance(std::size_t bug) const override;
    bool at_target(std::size_t bug) const override { return target_distance(bug) < rules().reach; }
    void note_touches() override { physics_->note_touches(); }
    bool touched(std::size_t bug) const override { return physics_->touched(bug); }

    /// The patches are found by the first call. Throws std::runtime_error when the picture of a floor cannot
    /// be read.
    std::vector<std::string> patch_colours() const override;
    /// The patch at looks_at(). Empty before the first call of patch_colours().
    std::optional<std::size_t> patch_in_view(std::size_t bug) const override;

    std::vector<Score> scores() const override;
    std::optional<double> game_time_left() const override;
    std::string score_csv() const override;

    std::size_t movable_objects() const { return movable_objects_.size(); }
    const MovableObject& movable_object(std::size_t i) const { return movable_objects_[i]; }
    /// The pose of a movable object; empty when the object is removed.
    std::optional<Pose2> movable_object_pose(std::size_t i) const;

    const std::vector<Eigen::Vector2d>& targets() const { return targets_; }  ///< centres, m
    std::optional<ResetPlan> reset_plan() const { return plan_; }             ///< start poses and bounds
    const Game& game() const { return game_; }
    /// The rules of trials in the world's file, or the defaults.
    const TrialRules& rules() const {
        static const TrialRules defaults;
        return description_.trials ? *description_.trials : defaults;
    }
    const Robot& robot(std::size_t bug) const { return robots_[bug]; }
    const BodyPoses& body_poses() const { return body_poses_; }  ///< poses at the end of the last cycle
    std::span<const MovingVisual> moving_visuals() const { return moving_visuals_.all(); }
    /// The visible solids of static models and of movable objects, for drawing.
    std::vector<DrawnSolid> drawing() const;
    /// The static visuals, for cameras and maps. They are built by the first call. Throws std::runtime_error
    /// when the picture of a floor cannot be read.
    std::shared_ptr<const Scene> scene() const { return surroundings_->scene(); }
    const WorldDescription& description() const { return description_; }
    const Physics& physics() const { return *physics_; }

  private:
    World(std::shared_ptr<const WorldDescription> description, const WorldOptions& options);
    // ---- construction ----
    bool build(Diagnostics& diagnostics);
    void add_robot(const Model& model, Diagnostics& diagnostics);
    void add_movable_objects(Diagnostics& diagnostics);
    void add_game();
    void place_bodies(Diagnostics& diagnostics);
    void add_sensors();
    // ---- motion ----
    std::uint64_t substeps_before(std::uint64_t cycle) const;
    bool every_substep_matters(std::uint64_t steps) const;
    void move_bodies(std::uint64_t steps);
    bool move_body(std::size_t body, const Pose2& pose);
    void move_island(std::size_t island, std::uint64_t steps);
    bool may_reach_target(std::size_t bug, std::uint64_t steps) const;
    Velocity drive(std::size_t bug, std::uint64_t substep, std::uint64_t steps);
    void drive_freely(std::size_t island, std::uint64_t steps);
    bool update_reset(std::size_t bug);
    bool is_over(std::size_t bug) const;
    // ---- sensing ----
    void update_body_poses();
    void colour_resources();
    void sense_due();
    void exchange_messages();
    void remember();
    void make_camera(std::size_t bug);
    MovingVisuals& visuals();

    std::shared_ptr<const WorldDescription> shared_description_;
    const WorldDescription& description_;
    WorldOptions options_;
    double substeps_per_cycle_;  ///< a mean; need not be an integer
    std::uint64_t cycle_ = 0, substep_ = 0;
    std::optional<ResetPlan> plan_;
    std::vector<Eigen::Vector2d> targets_;
    Heights heights_;
    std::vector<Robot> robots_;
    std::vector<MovableObject> movable_objects_;
    std::vector<Body> bodies_;          ///< the robots, then the movable objects
    std::vector<std::size_t> by_name_;  ///< the robots in byte order of their names
    std::vector<Transceiver*> transceivers_;
    Game game_;
    BodyPoses body_poses_;
    MovingVisuals moving_visuals_;  ///< visuals of all robots and movable objects
    bool visuals_placed_ = false;   ///< whether those that are placed are at the body poses
    std::vector<char> driven_;      ///< per robot: whether it is driven, not being reset
    std::vector<Reach> reach_;      ///< per body, per substep
    std::vector<Velocity> drives_;  ///< of the robots in the current stride, with noise
    std::unique_ptr<Physics> physics_;
    std::shared_ptr<Surroundings> surroundings_;
    mutable const std::vector<Patch>* patches_ = nullptr;  ///< those of the surroundings, once asked for
};

/// A description of a world for users: robots, start poses, targets, bounds, whether there are trials, and
/// the simulated time per cycle.
std::string describe(const World& world);

}  // namespace forage::bug
