// Runs for learning agents. forage/gym.py gives them the interfaces of Gymnasium and PettingZoo.
#include "tools/api/agents/agents.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <string_view>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/base/sequence.h"
#include "core/run/weights.h"
#include "tools/api/agents/agent_pool.h"
#include "tools/python/run.h"
#include "tools/python/values.h"
#include "tools/python/weights.h"

namespace forage::python {
namespace {

using namespace py::literals;
using std::filesystem::path;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Task = std::shared_ptr<const AgentTask>;
/// A sensor or motor: its name, and its rows and columns without a system; 0 for the usual size.
using Port = std::tuple<std::string, int, int>;

/// Lets one thread at a time use an object while others run Python.
class InUse {
  public:
    explicit InUse(std::atomic_flag& flag) : flag_(flag) {
        if (flag.test_and_set()) throw engine::RunError("this environment is running in another thread");
    }
    ~InUse() { flag_.clear(); }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

  private:
    std::atomic_flag& flag_;
};

/// The function `f` of an object, which it does not share with another thread meanwhile.
template <class Result, class Self, class... Arguments>
auto alone(Result (*f)(Self&, Arguments...)) {
    return [f](Self& self, Arguments... arguments) {
        const InUse use(self.in_use);
        return f(self, std::forward<Arguments>(arguments)...);
    };
}

struct PythonAgents {
    explicit PythonAgents(Task task) : run(std::move(task)) {}
    AgentRun run;
    mutable std::atomic_flag in_use;
    std::weak_ptr<PythonRun> shown;  ///< the last result of shown_run()
};

struct PythonPool {
    PythonPool(const Task& task, std::size_t runs, int threads) : pool(task, runs, threads) {}
    AgentPool pool;
    std::atomic_flag in_use;
    std::vector<std::weak_ptr<PythonRun>> shown = std::vector<std::weak_ptr<PythonRun>>(pool.size());
};

/// The run of an agent as Python sees it: the same object while it is used, and the agent has this run.
std::shared_ptr<PythonRun> shown_run(const AgentRun& agent, std::weak_ptr<PythonRun>& shown) {
    auto out = shown.lock();
    if (!out || out->closed() || out->owner() != agent.run())
        shown = out = std::make_shared<PythonRun>(agent.run(), PythonRun::OnNan::ignore);
    return out;
}

ActionKind action_kind(const std::string& name) {
    static const std::vector<std::string> names{"cell", "velocity", "activity"};
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw InputError("'" + name + "' is not a kind of action", "cell, velocity or activity");
    return static_cast<ActionKind>(found - names.begin());
}

std::vector<AgentGroup> groups_of(const std::vector<Port>& ports) {
    return collected(ports, [](const Port& p) {
        return AgentGroup{std::get<0>(p), std::get<2>(p), std::get<1>(p)};
    });
}

std::vector<std::string> port_names(const std::vector<Port>& ports) {
    return collected(ports, [](const Port& p) { return std::get<0>(p); });
}

/// What agents do in a world, as AgentRun and AgentPool are given it (forage/gym.py).
Task read_task(const py::kwargs& given) {
    AgentOptions options;
    path world;
    std::optional<path> system;
    std::vector<path> plugins;
    std::vector<std::tuple<std::string, std::vector<Port>, std::vector<Port>, std::string>> agents;
    std::string action;
    std::pair<double, double> speed;
    RunInput& input = options.input;
    take(given, "world", world), take(given, "system", system), take(given, "plugins", plugins);
    take(given, "agents", agents), take(given, "every_robot", options.every_robot);
    take(given, "action", action), take(given, "speed", speed), take(given, "paths", options.paths);
    take(given, "cycles_per_step", options.cycles_per_step), take(given, "max_steps", options.max_steps);
    take(given, "end_at_target", options.end_at_target), take(given, "seed", input.seed);
    take(given, "noise", input.noise), take(given, "real_time_factor", input.real_time_factor);
    input.world = world.string(), input.plugins = texts_of(plugins);
    if (system) input.system = system->string();
    for (const auto& setting : assignments(given["settings"])) input.settings.push_back({setting});
    for (const auto& [robot, sensors, motors, reward] : agents) {
        Agent agent{.robot = robot, .reward = reward};
        if (system)
            agent.sensors = port_names(sensors), agent.motors = port_names(motors);
        else
            agent.body = {{}, groups_of(sensors), groups_of(motors), speed.first, speed.second};
        options.agents.push_back(std::move(agent));
    }
    options.action = action_kind(action);
    return AgentTask::read(std::move(options));
}

py::array_t<float> observation(const PythonAgents& self, std::size_t agent) {
    const InUse use(self.in_use);
    const auto numbers = self.run.observation(agent);
    return py::array_t<float>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Texts that NumPy would read as numbers are none.
Numbers numbers_in(const py::handle& action) {
    const auto given = py::array::ensure(action);
    if (!given || std::string_view("biuf").find(given.dtype().kind()) == std::string_view::npos)
        throw InputError("an action is a number, or an array of numbers");
    return Numbers(given);
}

void act(PythonAgents& self, std::size_t agent, const py::handle& action) {
    const InUse use(self.in_use);
    if (PyLong_Check(action.ptr()) || PyFloat_Check(action.ptr())) {
        const double number = PyFloat_AsDouble(action.ptr());
        if (number == -1 && PyErr_Occurred()) throw py::error_already_set();
        return self.run.act(agent, {&number, 1});
    }
    const auto numbers = numbers_in(action);
    self.run.act(agent, {numbers.data(), static_cast<std::size_t>(numbers.size())});
}

py::tuple outcome(const PythonAgents& self, std::size_t agent) {
    const auto o = self.run.outcome(agent);
    return py::make_tuple(observation(self, agent), o.reward, o.terminated, o.truncated, o.reached_target);
}

void step(PythonAgents& self) {
    const InUse use(self.in_use);
    const py::gil_scoped_release others;
    self.run.step();
}

py::tuple step_with(PythonAgents& self, const py::object& action) {
    act(self, 0, action);
    step(self);
    return outcome(self, 0);
}

using Starts = std::vector<std::array<double, 3>>;

std::vector<Pose2> poses_of(const Starts& starts) {
    return collected(starts, [](const auto& s) { return Pose2{s[0], s[1], s[2]}; });
}

void reset(PythonAgents& self, std::optional<std::uint64_t> seed, const Starts& starts) {
    const auto poses = poses_of(starts);
    const py::gil_scoped_release others;
    self.run.reset(seed, poses);
}

py::list ports(const std::vector<AgentPort>& all) {
    py::list out;
    for (const auto& p : all) out.append(py::make_tuple(p.name, py::tuple(py::cast(p.shape)), p.unit_range));
    return out;
}

py::array_t<std::uint8_t> picture_of(AgentRun& agent) {
    const plot::Pixels pixels = agent.picture();
    py::array_t<std::uint8_t> out({pixels.height, pixels.width, 3});
    auto* to = out.mutable_data();
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x)
            for (const int shift : {16, 8, 0})
                *to++ = static_cast<std::uint8_t>(
                    pixels.rgb[static_cast<std::size_t>(y) * pixels.stride + static_cast<std::size_t>(x)] >>
                    shift);
    return out;
}

/// The number of an environment. Throws InputError.
std::size_t index_in(const PythonPool& self, std::int64_t i) {
    const auto count = static_cast<std::int64_t>(self.pool.size());
    if (i < 0 || i >= count) throw InputError("there is no environment " + std::to_string(i));
    return static_cast<std::size_t>(i);
}

template <class T>
std::span<T> span_of(py::array_t<T>& array) {
    return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

py::array_t<float> table_of(AgentPool& pool) {
    return py::array_t<float>({pool.size(), pool[0].observation(0).size()});
}

py::array_t<float> reset_pool(PythonPool& self, const std::vector<std::optional<std::uint64_t>>& seeds,
                              const Starts& starts, const std::optional<py::array_t<bool>>& mask) {
    const auto poses = poses_of(starts);
    auto out = table_of(self.pool);
    const auto rows = span_of(out);
    const std::span<const bool> chosen =
        mask ? std::span<const bool>(mask->data(), static_cast<std::size_t>(mask->size()))
             : std::span<const bool>();
    const py::gil_scoped_release others;
    self.pool.reset(seeds, poses, chosen, rows);
    return out;
}

/// Sets the weights of a connection of environments: `runs` is 1, or the number of runs of a pool.
template <class Agents>
void set_weights(Agents& agents, const Run& run, std::size_t runs, const std::string& name,
                 const py::object& values) {
    const auto array = weights_of(values, run, find_connection(run, name), runs);
    agents.set_weights(name, {array.data(), static_cast<std::size_t>(array.size())});
}

py::tuple step_pool(PythonPool& self, const py::object& given) {
    const Numbers actions = numbers_in(given);
    AgentPool& pool = self.pool;
    const auto runs = static_cast<py::ssize_t>(pool.size());
    if (static_cast<std::size_t>(actions.size()) != pool.size() * pool[0].action_size(0))
        throw InputError("the actions of " + std::to_string(runs) + " environments have " +
                         std::to_string(runs * static_cast<py::ssize_t>(pool[0].action_size(0))) +
                         " numbers, not " + std::to_string(actions.size()));
    auto observations = table_of(pool);
    py::array_t<double> rewards(runs);
    py::array_t<bool> terminated(runs), truncated(runs), reached(runs);
    const AgentPool::Rows rows{span_of(observations), span_of(rewards), span_of(terminated),
                               span_of(truncated), span_of(reached)};
    const std::span<const double> numbers(actions.data(), static_cast<std::size_t>(actions.size()));
    {
        const py::gil_scoped_release others;
        pool.step(numbers, rows);
    }
    return py::make_tuple(observations, rewards, terminated, truncated, reached);
}

}  // namespace

void add_agents(py::module_& module) {
    py::class_<PythonAgents>(module, "AgentRun", "A run that agents drive. forage.gym uses it.")
        .def(py::init([](const py::kwargs& task) { return std::make_unique<PythonAgents>(read_task(task)); }))
        .def("reset", alone(&reset), "seed"_a, "starts"_a)
        .def(
            "act", [](PythonAgents& self, std::size_t i, const py::object& a) { act(self, i, a); }, "agent"_a,
            "action"_a)
        .def(
            "is_connection",
            [](const PythonAgents& self, const std::string& name) {
                return is_connection(*self.run.run(), name);
            },
            "name"_a)
        .def("set_parameter",
             alone(+[](PythonAgents& self, const std::string& assignment) { self.run.set(assignment); }),
             "assignment"_a)
        .def("set_weights",
             alone(+[](PythonAgents& self, const std::string& name, const py::object& weights) {
                 set_weights(self.run, *self.run.run(), 1, name, weights);
             }),
             "connection"_a, "weights"_a)
        .def("step", &step)
        .def("step_with", &step_with, "action"_a)
        .def("observation", &observation, "agent"_a)
        .def("outcome", &outcome, "agent"_a)
        .def(
            "sensors", [](const PythonAgents& self, std::size_t i) { return ports(self.run.sensors(i)); },
            "agent"_a)
        .def(
            "motors", [](const PythonAgents& self, std::size_t i) { return ports(self.run.motors(i)); },
            "agent"_a)
        .def("picture", alone(+[](PythonAgents& self) { return picture_of(self.run); }))
        .def_property_readonly("run",
                               alone(+[](PythonAgents& self) { return shown_run(self.run, self.shown); }))
        .def("save", alone(+[](PythonAgents& self) { return py::bytes(self.run.save()); }))
        .def("restore", alone(+[](PythonAgents& self, const std::string& state) { self.run.restore(state); }),
             "state"_a)
        .def_property_readonly("robots", [](const PythonAgents& self) {
            std::vector<std::string> out;
            for (std::size_t i = 0; i < self.run.agents(); ++i) out.push_back(self.run.robot(i));
            return out;
        });
    py::class_<PythonPool>(module, "AgentPool", "Runs that are stepped together. forage.gym uses it.")
        .def(py::init([](std::size_t runs, int threads, const py::kwargs& task) {
                 return std::make_unique<PythonPool>(read_task(task), runs, threads);
             }),
             "runs"_a, "threads"_a)
        .def("reset", alone(&reset_pool), "seeds"_a, "starts"_a, "mask"_a)
        .def(
            "is_connection",
            [](PythonPool& self, const std::string& name) {
                return is_connection(*self.pool[0].run(), name);
            },
            "name"_a)
        .def("set_parameters",
             alone(+[](PythonPool& self, const std::vector<std::string>& all) { self.pool.set(all); }),
             "assignments"_a)
        .def("set_weights", alone(+[](PythonPool& self, const std::string& name, const py::object& weights) {
                 set_weights(self.pool, *self.pool[0].run(), self.pool.size(), name, weights);
             }),
             "connection"_a, "weights"_a)
        .def("step", alone(&step_pool), "actions"_a)
        .def("run", alone(+[](PythonPool& self, std::int64_t i) {
                 const auto at = index_in(self, i);
                 return shown_run(self.pool[at], self.shown[at]);
             }),
             "environment"_a)
        .def("picture", alone(+[](PythonPool& self, std::int64_t i) {
                 return picture_of(self.pool[index_in(self, i)]);
             }),
             "environment"_a)
        .def("save", alone(+[](PythonPool& self) {
                 py::list out;
                 for (std::size_t i = 0; i < self.pool.size(); ++i)
                     out.append(py::bytes(self.pool[i].save()));
                 return out;
             }))
        .def("restore", alone(+[](PythonPool& self, const std::vector<std::string>& states) {
                 for (std::size_t i = 0; i < std::min(states.size(), self.pool.size()); ++i)
                     self.pool[i].restore(states[i]);
             }),
             "states"_a)
        .def("sensors", [](PythonPool& self) { return ports(self.pool[0].sensors(0)); })
        .def("motors", [](PythonPool& self) { return ports(self.pool[0].motors(0)); })
        .def_property_readonly("threads", [](const PythonPool& self) { return self.pool.threads(); });
}

}  // namespace forage::python
