// The world of a run, as far as the run needs to know it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/run/trial.h"

namespace forage {

/// What a system acts in and senses: it advances by one cycle after each cycle of the system. Modules that need it get
/// it at start (ModulePorts::environment) and know its real type. bug_interface/simulation/world.h is the one that ships; a
/// world without robots implements the first three functions only.
class Environment {
  public:
    virtual ~Environment() = default;

    /// Seconds of the world that pass in one cycle.
    virtual double seconds_per_cycle() const = 0;
    /// Advances the world by one cycle; afterwards modules can read what the robots sense.
    virtual void step() = 0;
    /// Reads or writes everything that changes in the world. Between cycles only.
    virtual void checkpoint(Archive& archive) = 0;

    /// The names of the robots; functions below count robots from 0 in this order.
    virtual std::vector<std::string> robot_names() const { return {}; }
    /// Where the robot stands.
    virtual Pose2 pose(std::size_t /*robot*/) const { return {}; }

    /// Whether the world puts this robot back to a start pose, which ends a trial.
    virtual bool has_trials(std::size_t /*robot*/) const { return false; }
    /// The finished trials of a robot, in order.
    virtual const std::vector<Trial>& trials(std::size_t /*robot*/) const {
        static const std::vector<Trial> none;
        return none;
    }
    /// The running trial; during a reset, the trial to come.
    virtual Trial current_trial(std::size_t /*robot*/) const { return {}; }
    /// Whether the robot is being put back to a start pose.
    virtual bool resetting(std::size_t /*robot*/) const { return false; }
    /// The poses from which trials start; empty in a world without trials.
    virtual std::vector<Pose2> start_poses() const { return {}; }
    /// Whether trials have a target to reach.
    virtual bool has_targets() const { return false; }

    /// The colours of the patches on the floor; patch numbers index this list.
    virtual std::vector<std::string> patch_colours() const { return {}; }
    /// The number of the patch in the middle of the robot's view; empty when there is none.
    virtual std::optional<std::size_t> patch_in_view(std::size_t /*robot*/) const { return std::nullopt; }

    /// One team's result in a game.
    struct Score {
        std::string team;
        int points = 0;
        int good = 0, bad = 0;  ///< resources delivered
    };
    /// The result of a game so far; empty when no game is played.
    virtual std::vector<Score> scores() const { return {}; }
    /// Seconds that are left in a game; empty when it has no time limit or none is played.
    virtual std::optional<double> game_time_left() const { return std::nullopt; }
    /// One row per delivery of a game: seconds,team,resource,points,score_a,score_b.
    virtual std::string score_csv() const { return {}; }
};

}  // namespace forage
