// A world in lock-step with a neural system: robots move for one cycle, then sense.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "bug_interface/simulation/game.h"
#include "bug_interface/simulation/patches.h"
#include "bug_interface/simulation/robot.h"
#include "bug_interface/simulation/surroundings.h"
#include "bug_interface/simulation/movable_object.h"
#include "bug_interface/simulation/trials.h"
#include "bug_interface/world/description.h"
#include "core/base/diagnostic.h"
#include "core/run/environment.h"

namespace forage::bug {

struct WorldOptions {
    std::uint64_t seed = 1;
    double cycles_per_second = 25;  ///< of the neural system, per second of the clock
    std::optional<double>
        real_time_factor;  ///< seconds of the world per second of the clock; default: what the file asks for
    bool noise = true;     ///< of motors, scanners and cameras; resets are drawn all the same
    bool sensor_rates = false;  ///< scans and pictures at the rates of their sensors, instead of every cycle
    int latency = 0;               ///< cycles by which what is sensed reaches the modules later
    bool game = false;          ///< play the challenge's game, also where the world has no rules
};

/// Robots in a world. A robot is a model with a link named "bug" and the velocity plugin; those with the
/// reset plugin are put back to a start pose when they leave the bounds, which ends a trial.
///
/// In a run, per cycle: the neural system steps (its module reads the snapshots and gives commands), then
/// step(). Everything follows from the options' seed; robots and uses (motor noise, each scanner, camera,
/// reset) have random streams of their own, so that doing without one of them leaves the others as they are.
/// Not to be used from two threads at a time. Robots are counted from 0, in file order.
///
/// What is neither fixed nor a robot is loose: it can be pushed and carried. Things touch where they share
/// heights.
class World final : public Environment {
  public:
    /// Null when the world cannot be simulated; `diagnostics` then says why.
    static std::unique_ptr<World> make(const WorldDescription& description, const WorldOptions& options,
                                       Diagnostics& diagnostics);

    double seconds_per_cycle() const override {
        return substeps_per_cycle_ * description_.step;
    }  ///< of the world; a mean
    double time() const { return static_cast<double>(substep_) * description_.step; }  ///< s since the start
    std::uint64_t cycle() const { return cycle_; }                                     ///< cycles done
    std::uint64_t substeps() const { return substep_; }                                ///< physics steps done

    /// One cycle: its substeps, then a snapshot of every robot. The first snapshot is taken at construction.
    void step() override;
    // The parts of step(), for benchmarks; in this order, since scans and pictures are of the cycle that
    // advance_bodies() ended.
    void advance_bodies();  ///< the substeps of a cycle
    void scan();            ///< poses and range scans into the snapshots; the same again when called again
    void render();          ///< pictures into the snapshots of the robots of which they are wanted

    std::size_t bugs() const { return robots_.size(); }
    std::vector<std::string> robot_names() const override;
    std::optional<std::size_t> find(std::string_view bug) const;
    /// What modules get: of the last cycle, or of an earlier one when the options have it late.
    const BugSnapshot& snapshot(std::size_t bug) const;
    /// For onlookers: what its camera sees at the end of the last cycle, whether or not a module takes its
    /// pictures, how often and how late. Empty without a camera; valid until the next call for this robot.
    /// Throws std::runtime_error when a floor's picture cannot be read.
    std::span<const std::uint8_t> image(std::size_t bug);
    /// Whether this robot's snapshots have pictures.
    void need_image(std::size_t bug, bool needed);

    /// All that changes in it; between cycles. To be read into a world made of the same description, with the
    /// same options, which the same modules have started to use. Throws ArchiveError when it does not fit.
    void checkpoint(Archive& archive) override;

    /// Holds until the next command. The first is to stand still.
    void command(std::size_t bug, const MotorCommand& command) { robots_[bug].command = command; }
    /// Opens or closes the gripper; it closes only after it was opened. Holds until the next.
    void grip(std::size_t bug, bool close) { robots_[bug].hinges.command(close); }
    bool has_gripper(std::size_t bug) const { return !robots_[bug].hinges.empty(); }
    double gripper_angle(std::size_t bug, std::size_t hinge) const {
        return robots_[bug].hinges[hinge].angle;
    }  ///< rad
    /// Whether the gripper's rays are scanned.
    void need_gripper_scan(std::size_t bug, bool needed);
    /// Transmits `cells` to all robots with the same key, which receive them in the next cycle. Called once per
    /// cycle.
    void transmit(std::size_t bug, std::string_view key, std::span<const double> cells) {
        robots_[bug].transceiver.transmit(key, cells, robots_[bug].snapshot.pose);
    }
    /// A robot obeys one module: empty when it has one already. The claim ends with the returned object.
    std::shared_ptr<void> claim(std::size_t bug);

    Pose2 pose(std::size_t bug) const override { return robots_[bug].pose; }
    /// The point of the floor (z = 0) in the middle of its camera's picture; where it stands itself, for a
    /// robot without a camera or with one that does not look down. World frame, m.
    Eigen::Vector2d looks_at(std::size_t bug) const;
    /// Whether this robot is put back to a start pose when it leaves the bounds.
    bool has_trials(std::size_t bug) const override { return robots_[bug].reset.has_value(); }
    bool resetting(std::size_t bug) const override {
        return robots_[bug].reset && robots_[bug].reset->running();
    }

    const std::vector<Trial>& trials(std::size_t bug) const override {
        return robots_[bug].trials->finished();
    }
    Trial current_trial(std::size_t bug) const override;
    std::vector<Pose2> start_poses() const override { return plan_ ? plan_->starts : std::vector<Pose2>(); }
    bool has_targets() const override { return !targets_.empty(); }

    /// Patches are found when they are first asked for, so not by two threads at a time. Throws std::runtime_error
    /// when a floor's picture cannot be read.
    std::vector<std::string> patch_colours() const override;
    /// The patch at looks_at(); patch_colours() must have been called.
    std::optional<std::size_t> patch_in_view(std::size_t bug) const override;

    std::vector<Score> scores() const override;
    std::optional<double> game_time_left() const override;
    std::string score_csv() const override;

    const std::vector<Eigen::Vector2d>& targets() const { return targets_; }  ///< their middles, m
    std::optional<ResetPlan> reset_plan() const { return plan_; }             ///< start poses and bounds
    /// For drawing: what stands still, and where loose things are now.
    std::vector<DrawnSolid> drawing() const;
    std::size_t movable_objects() const { return movable_objects_.size(); }
    const MovableObject& movable_object(std::size_t i) const { return movable_objects_[i]; }
    /// Where a loose thing is; empty when it is away.
    std::optional<Pose2> movable_object_pose(std::size_t i) const;
    const Game& game() const { return game_; }
    const Robot& robot(std::size_t bug) const { return robots_[bug]; }
    const BodyPoses& body_poses() const { return body_poses_; }  ///< at the last snapshot
    std::span<const MovingVisual> moving_visuals() const { return moving_visuals_; }
    /// What stands still, for cameras and maps: made when it is first asked for, so not by two threads at a
    /// time. Throws std::runtime_error when a floor's picture cannot be read.
    std::shared_ptr<const Scene> scene() const;
    const WorldDescription& description() const { return description_; }
    const Physics& physics() const { return *physics_; }

  private:
    World(const WorldDescription& description, const WorldOptions& options);
    bool build(Diagnostics& diagnostics);
    void add_robot(const Model& model, Diagnostics& diagnostics);
    void add_movable_objects(Diagnostics& diagnostics);
    void add_game();
    void place_all(Diagnostics& diagnostics);
    void surround();
    bool in_reset(std::size_t bug);  ///< one substep of the reset rule: true when the robot is not driven
    void drive(std::size_t bug);
    bool drive_freely(std::uint64_t last);  ///< all substeps before `last` at once, when that is the same
    bool is_free(std::size_t bug, double seconds);
    void update_body_poses();
    void sense_when_due();
    void colour_resources();
    void exchange_messages();
    void remember();
    std::span<const MovingVisual> placed_visuals();
    void make_camera(std::size_t bug);
    std::uint64_t substeps_before(std::uint64_t cycle) const;

    WorldDescription description_;
    WorldOptions options_;
    double substeps_per_cycle_;
    std::uint64_t cycle_ = 0, substep_ = 0;
    std::optional<ResetPlan> plan_;
    std::vector<Eigen::Vector2d> targets_;
    Heights heights_;
    std::vector<Robot> robots_;
    std::vector<MovableObject> movable_objects_;
    std::vector<Body> bodies_;          ///< of the robots, then of the things
    std::vector<std::size_t> by_name_;  ///< the robots, in byte order of their names
    std::vector<Transceiver*> transceivers_;
    Game game_;
    BodyPoses body_poses_;
    std::vector<MovingVisual> moving_visuals_;   ///< of all that moves
    bool visuals_placed_ = false;        ///< whether their visuals are at the body poses
    std::vector<MotorCommand> drives_;  ///< of this substep, with noise
    std::unique_ptr<Physics> physics_;
    mutable std::shared_ptr<const Scene> scene_;
    mutable std::optional<std::vector<Patch>> patches_;
};

/// A world in a few lines for people: robots, start poses, targets, bounds, whether there are trials, and how
/// much time of the world a cycle takes.
std::string describe(const World& world);

}  // namespace forage::bug
