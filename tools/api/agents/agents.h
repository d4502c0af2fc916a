// Runs for learning agents: an agent senses and moves a robot, or groups of a brain, step by step.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <forage/forage.h>

#include "bug_interface/simulation/world.h"
#include "core/observe/source.h"
#include "core/run/run_spec.h"
#include "tools/api/agents/agent_system.h"
#include "tools/api/open/sources.h"
#include "tools/plot/gif.h"

namespace forage {

namespace plot {
class Film;
}

/// What the numbers of an action mean.
enum class ActionKind {
    cell,      ///< per motor group the number of its active cell; a single cell is active (1) or not (0)
    velocity,  ///< per square group forward and turn, -1 to 1 (1: ahead, left); per single cell its activity
    activity,  ///< the activities of all cells of the motor groups
};

/// One agent of a run.
struct Agent {
    std::string robot;    ///< the robot whose trials are its episodes; the world's first one when empty
    AgentBody body = {};  ///< used without a system
    std::vector<std::string> sensors = {};  ///< with a system: sources such as "Bug/Light"
    std::vector<std::string> motors = {};   ///< with a system: groups such as "Bug/Motor"
    /// A source of one number, read at the end of a step. When empty, reaching the target is worth 1.
    std::string reward = {};
};

struct AgentOptions {
    RunInput input;  ///< the world and the seed; without a system, the agents' bodies are the system
    std::vector<Agent> agents;
    bool every_robot = false;  ///< whether each robot of the world has an agent like the first one
    ActionKind action = ActionKind::cell;
    int cycles_per_step = 5;
    std::uint64_t max_steps = 1000;  ///< after which an episode is truncated; 0: never
    bool end_at_target = true;       ///< whether an episode ends when the robot reaches a target
    bool paths = false;              ///< whether a run keeps the paths of its robots, for its trajectory
};

/// Checked options and the content of their files. Many runs may share one.
class AgentTask {
  public:
    /// Throws InputError.
    static std::shared_ptr<const AgentTask> read(AgentOptions options);
    const AgentOptions& options() const { return options_; }
    /// A new run. Throws InputError.
    Run open(std::uint64_t seed) const;

  private:
    AgentOptions options_;
    Sources sources_;
};

/// A sensor or motor group of an agent: a flat piece of its observation or action.
struct AgentPort {
    std::string name;
    std::vector<int> shape;   ///< rows, columns; one number for a group without them
    bool unit_range = false;  ///< whether all numbers are certain to be between 0 and 1
};

/// A run that agents drive. Their motor groups are overwritten after each update of the groups, so modules
/// and connections read what the agents do. What an agent senses is the activity of its sensor groups after
/// the last cycle of a step.
class AgentRun {
  public:
    /// What a step brought an agent.
    struct Outcome {
        double reward = 0;
        bool terminated = false;  ///< it reached a target or left the bounds: its episode has ended
        bool truncated = false;   ///< the episode is longer than it may be
        bool reached_target = false;
        bool ended() const { return terminated || truncated; }
    };

    /// Opens the run, with the seed of the task if none is given, and begins an episode. Throws InputError.
    explicit AgentRun(std::shared_ptr<const AgentTask> task, std::optional<std::uint64_t> seed = {});
    /// A further run of the same task, which shares what is constant.
    AgentRun(const AgentRun& other, std::uint64_t seed);
    AgentRun(AgentRun&&) noexcept;
    ~AgentRun();

    /// Begins an episode of all agents: their robots are at new start poses, or at `starts`. The robots stand
    /// for as many cycles as a sensed value needs to its group. With a seed the run is restarted;
    /// otherwise a brain keeps what it has learned. Throws InputError when `starts` has not one pose per
    /// agent, and for poses that are out of bounds, where something is, or where a trial ends at once; the
    /// next reset() begins an episode.
    void reset(std::optional<std::uint64_t> seed = {}, std::span<const Pose2> starts = {});
    /// Sets a parameter, "Process/Group.threshold=0.5", in this run and in those that reset() restarts.
    /// Throws InputError.
    void set(const std::string& assignment);
    /// Does the same with the weights of a connection: a row per target cell (core/run/weights.h).
    void set_weights(const std::string& connection, std::span<const double> weights);
    /// Sets the action of an agent until the next one. Throws InputError for numbers that ActionKind does not
    /// name.
    void act(std::size_t agent, std::span<const double> action);
    /// Runs the cycles of a step; fewer when the episodes of all agents end. Throws engine::RunError when
    /// they have ended before.
    void step();

    /// What the run and its agents need to continue, for restore() in a run of the same task. Throws
    /// InputError when the run has probes, manipulations or measures.
    std::string save();
    /// Throws ArchiveError.
    void restore(std::string_view state);

    std::size_t agents() const { return agents_.size(); }
    std::string robot(std::size_t agent) const;  ///< its name
    const std::vector<AgentPort>& sensors(std::size_t agent) const { return agents_[agent].sensors; }
    const std::vector<AgentPort>& motors(std::size_t agent) const { return agents_[agent].motors; }
    std::size_t action_size(std::size_t agent) const { return agents_[agent].action_size; }
    /// What the agent senses: the numbers of all its sensors, row by row, one sensor after the other.
    std::span<const float> observation(std::size_t agent) const { return agents_[agent].observation; }
    const Outcome& outcome(std::size_t agent) const { return agents_[agent].outcome; }
    /// Whether the episodes of all agents have ended.
    bool ended() const;
    const std::shared_ptr<Run>& run() const { return run_; }
    bug::World& world() const { return *world_; }
    /// The world from above and what the robots' cameras see, now. Valid until the next call.
    plot::Pixels picture();

  private:
    class Driver;
    /// A group that an agent overwrites, and with what.
    struct Motor {
        int group;
        GroupShape shape;
        std::vector<double> activity;
    };
    struct State {
        std::size_t robot = 0, first_motor = 0, action_size = 0;
        std::vector<AgentPort> sensors, motors;
        std::vector<observe::Source> sources;
        std::optional<observe::Source> reward;
        std::vector<float> observation;
        std::size_t trials = 0;  ///< the number of finished trials when the episode began
        Outcome outcome;
    };
    void open(Run run);
    State bind(const Agent& agent, Diagnostics& diagnostics);
    void check_starts(std::span<const Pose2> starts);
    void stop(const State& agent);
    void follow(State& agent);
    void sense(State& agent);
    void checkpoint(Archive& archive);

    std::shared_ptr<const AgentTask> task_;
    std::map<std::string, std::string> assignments_;  ///< of set(), by parameter
    std::map<int, std::vector<double>> weights_;      ///< of set_weights(), by connection
    std::shared_ptr<std::vector<Motor>> motors_;      ///< of all agents; the run's observer reads them
    std::shared_ptr<Run> run_;
    std::size_t observers_ = 0;  ///< of the run itself
    bug::World* world_ = nullptr;
    std::unique_ptr<plot::Film> film_;  ///< of the world; made by picture()
    std::vector<State> agents_;
    std::vector<double> row_;  ///< the numbers of a source
    std::uint64_t steps_ = 0;  ///< in this episode
};

}  // namespace forage
