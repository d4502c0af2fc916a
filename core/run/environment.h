// The interface of a world to a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/run/trial.h"

namespace forage {

/// The world that a system acts in and senses. It advances by one cycle after each cycle of the system.
/// Modules that need it get it at start (ModulePorts::environment) and know its real type.
/// bug_interface/simulation/world.h is the one that ships with Forage. A world without robots implements only
/// the first three functions.
class Environment {
  public:
    virtual ~Environment() = default;

    /// Seconds of the world that pass in one cycle.
    virtual double seconds_per_cycle() const = 0;
    /// Advances the world by one cycle; afterwards modules can read what the robots sense.
    virtual void step() = 0;
    /// Reads or writes everything that changes in the world. Called only between cycles.
    virtual void checkpoint(Archive& archive) = 0;
    /// Returns the same world as it begins with another seed, which shares what is constant; null when the
    /// world cannot do that. May be called while the world steps in another thread.
    virtual std::unique_ptr<Environment> restarted(std::uint64_t /*seed*/) const { return nullptr; }

    /// The names of the robots. The functions below number robots from 0 in this order.
    virtual std::vector<std::string> robot_names() const { return {}; }
    /// The current pose of a robot.
    virtual Pose2 pose(std::size_t /*robot*/) const { return {}; }
    /// Whether a module that has started drives the robot.
    virtual bool driven(std::size_t /*robot*/) const { return true; }

    /// Whether the world resets this robot to a start pose, which ends a trial.
    virtual bool has_trials(std::size_t /*robot*/) const { return false; }
    /// The finished trials of a robot, in order.
    virtual const std::vector<Trial>& trials(std::size_t /*robot*/) const {
        static const std::vector<Trial> none;
        return none;
    }
    /// The running trial; during a reset, the trial to come.
    virtual Trial current_trial(std::size_t /*robot*/) const { return {}; }
    /// Whether the robot is being reset to a start pose.
    virtual bool resetting(std::size_t /*robot*/) const { return false; }
    /// The poses from which trials start; empty in a world without trials.
    virtual std::vector<Pose2> start_poses() const { return {}; }
    /// Whether trials have a target to reach.
    virtual bool has_targets() const { return false; }
    /// The distance between the centres of a robot and of the nearest target, m; infinite without targets.
    virtual double target_distance(std::size_t /*robot*/) const {
        return std::numeric_limits<double>::infinity();
    }
    /// Whether a robot is where it reaches a target.
    virtual bool at_target(std::size_t /*robot*/) const { return false; }

    /// Makes the world note what touched() returns, which costs time. Called before the first cycle.
    virtual void note_touches() {}
    /// Whether a robot touched a wall, an object or another robot in the last cycle.
    virtual bool touched(std::size_t /*robot*/) const { return false; }

    /// The colours of the patches on the floor. Patch numbers are indices into this list.
    virtual std::vector<std::string> patch_colours() const { return {}; }
    /// The number of the patch in the centre of the robot's view; empty when there is none.
    virtual std::optional<std::size_t> patch_in_view(std::size_t /*robot*/) const { return std::nullopt; }

    /// The result of one team in a game.
    struct Score {
        std::string team;
        int points = 0;
        int good = 0, bad = 0;  ///< numbers of delivered resources
    };
    /// The current results of a game; empty when no game is played.
    virtual std::vector<Score> scores() const { return {}; }
    /// The time left in a game, s; empty when it has no time limit, or no game is played.
    virtual std::optional<double> game_time_left() const { return std::nullopt; }
    /// A table with one row per delivery of a game: seconds,team,resource,points,score_a,score_b.
    virtual std::string score_csv() const { return {}; }
};

}  // namespace forage
