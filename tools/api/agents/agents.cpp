#include "tools/api/agents/agents.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/world_queries.h"
#include "bug_interface/world/sdf_reader.h"
#include "core/base/sequence.h"
#include "core/model/expression.h"
#include "core/run/argument_checks.h"
#include "core/run/weights.h"
#include "tools/plot/film.h"

namespace forage {
namespace {

/// The cycles until what a robot senses at a new pose is the activity of a group: the world senses it at the
/// end of the first one, the module writes it in the second, and the group receives it in the third.
constexpr int cycles_to_sense = 3;

std::string path_of(const AgentBody& body, const AgentGroup& group) {
    return fmt::format("{}/{}", body.robot, group.port.starts_with('_') ? group.port.substr(1) : group.port);
}

/// Makes the agents that `every_robot` stands for, and names the robots and groups of those without a brain.
void complete_agents(AgentOptions& options, const bug::WorldDescription& world) {
    std::vector<std::string> robots;
    for (const auto& model : world.models)
        if (bug::robot_link(model)) robots.push_back(model.name);
    if (robots.empty()) throw InputError(fmt::format("the world '{}' has no robot", options.input.world));
    auto& agents = options.agents;
    if (options.every_robot) {
        agents.resize(robots.size(), Agent(agents.front()));
        for (std::size_t i = 0; i < robots.size(); ++i) agents[i].robot = robots[i];
    }
    for (auto& agent : agents) {
        if (agent.robot.empty()) agent.robot = robots.front();
        agent.body.robot = agent.robot;
        for (const auto& s : agent.body.sensors) agent.sensors.push_back(path_of(agent.body, s));
        for (const auto& m : agent.body.motors) agent.motors.push_back(path_of(agent.body, m));
    }
}

void check_options(const AgentOptions& options, Diagnostics& diagnostics) {
    if (options.input.world.empty()) diagnostics.error({}, "agents need a world", "name a .world file");
    if (options.cycles_per_step < 1)
        diagnostics.error({}, fmt::format("a step cannot have {} cycles", options.cycles_per_step),
                          "a step has at least 1 cycle");
    for (const auto& agent : options.agents) {
        if (agent.sensors.empty() && agent.body.sensors.empty())
            diagnostics.error({}, "an agent senses nothing", "name a sensor, such as 'target'");
        if (agent.motors.empty() && agent.body.motors.empty())
            diagnostics.error({}, "an agent moves nothing", "name a motor, such as 'motor'");
    }
}

std::vector<int> shape_of(const observe::Recorded& what) {
    if (what.one_number()) return {1};
    if (what.numbered) return {static_cast<int>(what.size())};
    return {what.cells.height, what.cells.width};
}

[[noreturn]] void refuse(const std::string& group, double value, const std::string& range) {
    throw InputError(fmt::format("{} is no action for '{}'", value, group), range);
}

std::size_t numbers_of_action(ActionKind kind, const std::string& name, const GroupShape& shape,
                              Diagnostics& diagnostics) {
    if (kind == ActionKind::activity) return static_cast<std::size_t>(shape.cells);
    if (kind == ActionKind::cell || shape.cells == 1) return 1;
    if (shape.width < 2 || shape.height < 2 || shape.cells != shape.width * shape.height)
        diagnostics.error({}, fmt::format("'{}' cannot take a velocity", name),
                          "only a rectangle of cells stands for velocities, such as the robot's motor group");
    return 2;
}

/// The row or column, of `cells`, that stands for `value`: the first one for 1, the last one for -1.
int nearest(double value, int cells) { return static_cast<int>(std::lround((1 - value) / 2 * (cells - 1))); }

}  // namespace

std::shared_ptr<const AgentTask> AgentTask::read(AgentOptions options) {
    auto out = std::make_shared<AgentTask>();
    Diagnostics diagnostics;
    check_options(options, diagnostics);
    throw_errors(diagnostics);
    const bool brain = !options.input.system.empty();
    if (brain) {
        out->sources_ = read_sources(options.input, diagnostics);
    } else {
        diagnostics.lenient = options.input.lenient;
        out->sources_.world = bug::read_world(options.input.world, diagnostics);
        if (out->sources_.world)
            out->sources_.surroundings = std::make_shared<bug::Surroundings>(*out->sources_.world);
    }
    throw_errors(diagnostics);
    complete_agents(options, *out->sources_.world);
    if (!brain)
        out->sources_.system =
            checked(diagnostics, agent_system(collected(options.agents, &Agent::body), diagnostics));
    out->options_ = std::move(options);
    return out;
}

Run AgentTask::open(std::uint64_t seed) const {
    RunInput input = options_.input;
    input.seed = seed;
    Diagnostics diagnostics;
    auto loaded = checked(diagnostics, assemble(sources_, input, diagnostics));
    OpenOptions open{.seed = seed,
                     .observe = std::vector<std::string>(),
                     .overwrite = std::vector<std::string>(),
                     .paths = options_.paths};
    for (const auto& agent : options_.agents) {
        open.observe->insert(open.observe->end(), agent.sensors.begin(), agent.sensors.end());
        if (!agent.reward.empty()) open.observe->push_back(agent.reward);
        open.overwrite->insert(open.overwrite->end(), agent.motors.begin(), agent.motors.end());
    }
    return forage::open(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                        open);
}

/// Overwrites the motor groups with the agents' actions.
class AgentRun::Driver final : public Observer {
  public:
    explicit Driver(std::shared_ptr<const std::vector<Motor>> motors) : motors_(std::move(motors)) {}
    void declare(engine::Demand& demand) const override {
        for (const Motor& m : *motors_) demand.overwrite_group(m.group);
    }
    void after_groups(RunView& run) override {
        for (const Motor& m : *motors_) std::ranges::copy(m.activity, run.simulation.output(m.group).data());
    }

  private:
    std::shared_ptr<const std::vector<Motor>> motors_;
};

AgentRun::AgentRun(std::shared_ptr<const AgentTask> task, std::optional<std::uint64_t> seed)
    : task_(std::move(task)) {
    open(task_->open(seed.value_or(task_->options().input.seed)));
    reset();
}

AgentRun::AgentRun(const AgentRun& other, std::uint64_t seed) : task_(other.task_) {
    open(restarted(*other.run_, seed));
    reset();
}

AgentRun::AgentRun(AgentRun&&) noexcept = default;
AgentRun::~AgentRun() = default;

void AgentRun::open(Run run) {
    film_.reset();
    run_ = std::make_shared<Run>(std::move(run));
    world_ = &dynamic_cast<bug::World&>(*run_->environment());
    motors_ = std::make_shared<std::vector<Motor>>();
    agents_.clear();
    Diagnostics diagnostics;
    for (const Agent& agent : task_->options().agents) agents_.push_back(bind(agent, diagnostics));
    throw_errors(diagnostics);
    run_->add(std::make_unique<Driver>(motors_));
    run_->start();
    observers_ = run_->observers().size();
    for (const auto& [parameter, assignment] : assignments_) run_->set(assignment);
    for (const auto& [connection, weights] : weights_)
        forage::set_weights(*run_, check_weights(*run_, connection, weights));
}

void AgentRun::set(const std::string& assignment) {
    run_->set(assignment);
    assignments_[std::string(expression::split_assignment(assignment).name)] = assignment;
}

void AgentRun::set_weights(const std::string& name, std::span<const double> weights) {
    const int connection = find_connection(*run_, name);
    forage::set_weights(*run_, check_weights(*run_, connection, weights));
    weights_[connection].assign(weights.begin(), weights.end());
}

AgentRun::State AgentRun::bind(const Agent& agent, Diagnostics& diagnostics) {
    State out;
    const auto robot = world_->find(agent.robot);
    if (!robot)
        diagnostics.error({}, fmt::format("there is no robot '{}' in the world", agent.robot),
                          suggest(agent.robot, world_->robot_names()));
    out.robot = robot.value_or(0);
    out.outcome.truncated = true;  // until reset() has begun an episode
    const auto& layout = run_->layout();
    const auto& sensors = agent.body.sensors;
    std::size_t numbers = 0;
    for (std::size_t i = 0; i < agent.sensors.size(); ++i) {
        auto source = observe::find_source(layout, agent.sensors[i], "sensor", diagnostics);
        if (!source) continue;
        out.sensors.push_back({agent.sensors[i], shape_of(source->what()),
                               i < sensors.size() && in_unit_range(sensors[i].port)});
        numbers += source->what().size();
        out.sources.push_back(std::move(*source));
    }
    out.observation.resize(numbers);
    if (!agent.reward.empty()) {
        out.reward = observe::find_source(layout, agent.reward, "reward", diagnostics);
        if (out.reward && out.reward->what().size() != 1)
            diagnostics.error({},
                              fmt::format("the reward '{}' is {} numbers, not one", agent.reward,
                                          out.reward->what().size()),
                              "take one cell, or their mean: mean(Process/Group)");
    }
    out.first_motor = motors_->size();
    for (const auto& name : agent.motors) {
        const auto column = observe::find_column(layout, name, "motor", diagnostics);
        if (!column) continue;
        const GroupShape& shape = layout.groups[static_cast<std::size_t>(column->group)].shape;
        out.motors.push_back({name, shape.cells == shape.width * shape.height
                                        ? std::vector<int>{shape.height, shape.width}
                                        : std::vector<int>{shape.cells}});
        out.action_size += numbers_of_action(task_->options().action, name, shape, diagnostics);
        motors_->push_back(
            {column->group, shape, std::vector<double>(static_cast<std::size_t>(shape.cells))});
    }
    return out;
}

void AgentRun::reset(std::optional<std::uint64_t> seed, std::span<const Pose2> starts) {
    if (!starts.empty() && starts.size() != task_->options().agents.size())
        throw InputError(fmt::format("there are {} start poses for {} agents", starts.size(),
                                     task_->options().agents.size()));
    for (const Pose2& start : starts) check_pose(start.x, start.y, start.yaw);
    if (seed) open(restarted(*run_, *seed));
    check_starts(starts);
    for (std::size_t i = 0; i < agents_.size(); ++i) {
        world_->begin_trial(agents_[i].robot, starts.empty() ? std::nullopt : std::optional(starts[i]));
        agents_[i].trials = world_->trials(agents_[i].robot).size();
        agents_[i].outcome = {.truncated = true};
        stop(agents_[i]);
    }
    for (int cycle = 0; cycle < cycles_to_sense; ++cycle) run_->step();
    for (std::size_t i = 0; i < starts.size(); ++i)
        if (world_->trials(agents_[i].robot).size() > agents_[i].trials)
            throw InputError(
                fmt::format("a trial from the start pose ({}, {}) ends at once", starts[i].x, starts[i].y),
                "the robot is at a target there, or at the bounds");
    steps_ = 0;
    for (auto& agent : agents_) {
        agent.outcome = {};
        agent.trials = world_->trials(agent.robot).size();
        sense(agent);
    }
}

std::string AgentRun::save() {
    if (run_->observers().size() != observers_)
        throw InputError("an environment whose run has probes, manipulations or measures cannot be copied",
                         "remove them first");
    Archive out;
    std::uint64_t seed = run_->seed();
    out(seed);
    checkpoint(out);
    return out.bytes();
}

void AgentRun::restore(std::string_view state) {
    Archive in(state);
    std::uint64_t seed = 0;
    in(seed);
    open(restarted(*run_, seed));
    checkpoint(in);
}

void AgentRun::checkpoint(Archive& archive) {
    archive(assignments_, weights_, steps_);
    for (auto& motor : *motors_) archive(motor.activity);
    for (auto& agent : agents_) {
        auto& o = agent.outcome;
        archive(agent.observation, agent.trials, o.reward, o.terminated, o.truncated, o.reached_target);
    }
    run_->checkpoint(archive);
}

void AgentRun::check_starts(std::span<const Pose2> starts) {
    const auto plan = world_->reset_plan();
    std::vector<std::pair<std::size_t, Pose2>> placed;
    for (const Pose2& start : starts) {
        if (plan && !plan->bounds.contains(Eigen::Vector2d(start.x, start.y)))
            throw InputError(
                fmt::format("the start pose ({}, {}) is out of bounds", start.x, start.y),
                fmt::format("x is {} to {}, and y is {} to {}", plan->bounds.min().x(),
                            plan->bounds.max().x(), plan->bounds.min().y(), plan->bounds.max().y()));
        placed.emplace_back(agents_[placed.size()].robot, start);
    }
    if (const auto blocked = world_->first_blocked(placed))
        throw InputError(fmt::format("something is already at the start pose ({}, {})", starts[*blocked].x,
                                     starts[*blocked].y),
                         "choose another place");
}

void AgentRun::act(std::size_t number, std::span<const double> action) {
    const State& agent = agents_[number];
    if (action.size() != agent.action_size)
        throw InputError(fmt::format("an action of {} numbers, not {}", action.size(), agent.action_size));
    const ActionKind kind = task_->options().action;
    for (std::size_t i = 0, next = 0; i < agent.motors.size(); ++i) {
        Motor& motor = (*motors_)[agent.first_motor + i];
        const std::string& name = agent.motors[i].name;
        const double value = action[next];
        const int cells = motor.shape.cells;
        if (kind == ActionKind::activity) {
            for (auto& cell : motor.activity) {
                cell = action[next++];
                if (!(cell >= 0 && cell <= 1)) refuse(name, cell, "0 to 1");
            }
            continue;
        }
        std::ranges::fill(motor.activity, 0);
        if (kind == ActionKind::velocity && cells > 1) {
            const double turn = action[next + 1];
            next += 2;
            for (const double v : {value, turn})
                if (!(v >= -1 && v <= 1)) refuse(name, v, "-1 to 1: forward, and turn");
            motor.activity[static_cast<std::size_t>(nearest(value, motor.shape.height) * motor.shape.width +
                                                    nearest(turn, motor.shape.width))] = 1;
            continue;
        }
        ++next;
        const bool number_of_cell = kind == ActionKind::cell;
        const double most = number_of_cell ? std::max(cells, 2) - 1 : 1;
        if (!(value >= 0 && value <= most) || (number_of_cell && value != std::floor(value)))
            refuse(name, value, fmt::format("{}0 to {}", number_of_cell ? "a whole number, " : "", most));
        motor.activity[cells == 1 ? 0 : static_cast<std::size_t>(value)] = cells == 1 ? value : 1;
    }
}

void AgentRun::stop(const State& agent) {
    for (std::size_t i = 0; i < agent.motors.size(); ++i)
        std::ranges::fill((*motors_)[agent.first_motor + i].activity, 0);
}

bool AgentRun::ended() const {
    return std::ranges::all_of(agents_, [](const State& a) { return a.outcome.ended(); });
}

std::string AgentRun::robot(std::size_t agent) const { return world_->robot_names()[agents_[agent].robot]; }

plot::Pixels AgentRun::picture() {
    if (!film_)
        film_ = std::make_unique<plot::Film>(*world_, "", run_->seconds_per_cycle(), run_->system().name);
    return film_->draw();
}

void AgentRun::step() {
    if (ended()) throw engine::RunError("the episode has ended: reset() begins the next one");
    const AgentOptions& options = task_->options();
    for (auto& agent : agents_) agent.outcome.reward = 0;
    for (int cycle = 0; cycle < options.cycles_per_step && !ended(); ++cycle) {
        run_->step();
        for (auto& agent : agents_)
            if (!agent.outcome.ended()) follow(agent);
    }
    ++steps_;
    for (auto& agent : agents_) {
        sense(agent);
        if (agent.outcome.ended()) continue;
        agent.outcome.truncated = options.max_steps > 0 && steps_ >= options.max_steps;
    }
}

/// Finds out what the last cycle brought an agent whose episode continues.
void AgentRun::follow(State& agent) {
    Outcome& outcome = agent.outcome;
    const auto& finished = world_->trials(agent.robot);
    const bool left = finished.size() > agent.trials;
    const bool reached = left ? finished.back().reached_target
                              : world_->has_targets() && world_->current_trial(agent.robot).reached_target;
    if (agent.reward)
        agent.reward->read(run_->simulation(), {&outcome.reward, 1});
    else if (reached && !outcome.reached_target)
        outcome.reward = 1;
    outcome.reached_target = reached;
    outcome.terminated = left || (reached && task_->options().end_at_target);
    if (outcome.terminated) stop(agent);
}

void AgentRun::sense(State& agent) {
    auto to = agent.observation.begin();
    for (const auto& source : agent.sources) {
        row_.resize(source.what().size());
        source.read(run_->simulation(), row_);
        to = std::ranges::transform(row_, to, [](double x) { return static_cast<float>(x); }).out;
    }
}

}  // namespace forage
