// Runs: opened from files, resumed from a saved state, and the methods that Python has for them.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/base/output_files.h"
#include "core/base/sequence.h"
#include "core/base/text_file.h"
#include "core/run/weights.h"
#include "tools/api/open/moves.h"
#include "tools/python/group.h"
#include "tools/python/picture.h"
#include "tools/python/probe.h"
#include "tools/python/run.h"
#include "tools/python/system.h"
#include "tools/python/tables.h"
#include "tools/python/values.h"
#include "tools/python/wiring.h"

namespace forage::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;
using SystemPointer = std::shared_ptr<PythonSystem>;
using Names = std::optional<std::vector<std::string>>;
using Count = std::optional<std::int64_t>;
using Seconds = std::optional<double>;
using OnNan = PythonRun::OnNan;

constexpr const char* on_nan_names[] = {"raise", "warn", "ignore", nullptr};
constexpr const char* on_timeout_names[] = {"truncate", "raise", nullptr};

std::shared_ptr<PythonRun> open_run(const std::variant<Path, SystemPointer>& system,
                                    const std::optional<Path>& world, std::uint64_t seed,
                                    const py::object& settings, const std::vector<Path>& plugins, int threads,
                                    bool lenient, bool noise, Seconds real_time_factor, const Names& observe,
                                    const Names& overwrite, const std::string& on_nan) {
    const auto nan = static_cast<OnNan>(choice(on_nan, on_nan_names, "on_nan"));
    OpenOptions options{.world = world ? world->string() : std::string(),
                        .seed = seed,
                        .settings = assignments(settings),
                        .plugins = texts_of(plugins),
                        .threads = threads,
                        .lenient = lenient,
                        .noise = noise,
                        .real_time_factor = real_time_factor,
                        .observe = observe,
                        .overwrite = overwrite,
                        .paths = true};
    const auto* const path = std::get_if<Path>(&system);
    const auto* const built = std::get_if<SystemPointer>(&system);
    if (built && !*built) throw py::type_error("the system is None");
    const auto file = built ? std::optional((*built)->file()) : std::nullopt;  // as it is now
    return warned([&](Diagnostics* warnings) {
        const py::gil_scoped_release others;
        return std::make_shared<PythonRun>(
            file ? open(*file, options, warnings) : open(path->string(), options, warnings), nan);
    });
}

/// Resumes a run from what save() wrote: bytes, a file that is open to be read, or the path of a file.
std::shared_ptr<PythonRun> resume_run(const py::object& state, bool trusted, const std::string& on_nan) {
    const auto nan = static_cast<OnNan>(choice(on_nan, on_nan_names, "on_nan"));
    std::string bytes;
    if (py::isinstance<py::bytes>(state))
        bytes = state.cast<std::string>();
    else if (py::hasattr(state, "read"))
        bytes = state.attr("read")().cast<std::string>();
    else {
        auto in = open_file(state.cast<Path>().string());
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    const py::gil_scoped_release others;
    return std::make_shared<PythonRun>(resume(bytes, trusted), nan);
}

std::shared_ptr<PythonRun> restart(PythonRun& self, std::uint64_t seed) {
    const Run& run = self.use();
    const py::gil_scoped_release others;
    return std::make_shared<PythonRun>(restarted(run, seed), self.on_nan());
}

py::object save(PythonRun& self, const py::object& file) {
    const std::string bytes = save_state(self.use());
    if (file.is_none()) return py::bytes(bytes);
    if (py::hasattr(file, "write"))
        file.attr("write")(py::bytes(bytes));
    else
        writing([&] { write_durably(file.cast<Path>().string(), bytes); });
    return py::none();
}

py::tuple reduce(PythonRun& self) {
    const char* on_nan = on_nan_names[static_cast<int>(self.on_nan())];
    return py::make_tuple(py::module_::import("forage._state").attr("resumed"),
                          py::make_tuple(save(self, py::none()), on_nan));
}

/// The function that shows progress: none, the caller's, or a bar for True.
py::object reporter(const py::object& progress) {
    if (!py::isinstance<py::bool_>(progress)) return progress;
    if (!progress.cast<bool>()) return py::none();
    return py::module_::import("forage._progress").attr("Bar")();
}

py::object on_cycle(PythonRun& self, const py::object& callback, std::uint64_t every) {
    if (!callback.is_none()) return self.on_cycle(callback, every), callback;
    return py::cpp_function([run = self.shared_from_this(), every](py::object decorated) {
        run->on_cycle(decorated, every);
        return decorated;
    });
}

RunLength length_of(Count cycles, Seconds seconds, Count trials, double trial_timeout) {
    return {.cycles = count_of("cycles", cycles),
            .seconds = seconds,
            .trials = count_of("trials", trials),
            .trial_timeout = trial_timeout};
}

bool truncates(const std::string& on_timeout) {
    return choice(on_timeout, on_timeout_names, "on_timeout") == 0;
}

void run_for(PythonRun& self, Count cycles, Seconds seconds, Count trials, const py::object& progress,
             double trial_timeout, const std::string& on_timeout) {
    const bool truncate = truncates(on_timeout);
    self.advance(length_of(cycles, seconds, trials, trial_timeout), reporter(progress), truncate);
}

bool run_until(PythonRun& self, const std::string& condition, Count cycles, Seconds seconds, Count trials,
               const py::object& progress, double trial_timeout, const std::string& on_timeout) {
    const bool truncate = truncates(on_timeout);
    RunLength length = length_of(cycles, seconds, trials, trial_timeout);
    length.until = {condition};
    return self.advance(length, reporter(progress), truncate);
}

py::array read(PythonRun& self, const std::string& source) {
    Diagnostics mistakes;
    const auto found = checked(mistakes, observe::find_source(self.use().layout(), source, "read", mistakes));
    return array_of(self.use().read(source), shape_of(found->what()));
}

std::vector<std::string> group_paths(const PythonRun& self) {
    return collected(self.use().layout().groups, &engine::Layout::Group::path);
}

/// A group; a connection that has no name of a group; or a state of a group, "Process/Group:vm".
py::object item(PythonRun& self, const std::string& name) {
    const Run& run = self.use();
    if (is_connection(run, name))
        return py::cast(PythonConnection{self.shared_from_this(), find_connection(run, name)});
    const PythonGroup group = find_group(self, name);
    if (group.about().path == name) return py::cast(group);
    const auto colon = name.rfind(':');
    return colon == name.npos ? py::cast(group) : state_of(group, name.substr(colon + 1));
}

bool run_has(const PythonRun& self, const py::object& key) {
    const Run& run = self.use();
    if (!py::isinstance<py::str>(key)) return false;
    const auto name = key.cast<std::string>();
    return is_connection(run, name) ||
           std::ranges::any_of(run.layout().groups, [&](const auto& g) { return g.path == name; });
}

std::vector<std::string> item_names(const PythonRun& self) {
    auto out = group_paths(self);
    for (const auto& c : self.use().layout().connections) out.push_back(c.name);
    return out;
}

void remove(PythonRun& self, const py::object& what) {
    if (py::isinstance<PythonProbe>(what))
        what.cast<PythonProbe&>().remove();
    else if (py::isinstance<PythonManipulation>(what))
        what.cast<PythonManipulation&>().remove();
    else if (!self.remove_callback(what))
        throw py::value_error("this run has no such probe, manipulation or callback");
}

std::string repr(const PythonRun& self) {
    if (const auto why = self.obstacle(); !why.empty()) return fmt::format("<forage.Run, {}>", why);
    const Run& r = self.use();
    std::string out =
        fmt::format("<forage.Run of '{}', seed {}, cycle {}", r.system().name, r.seed(), r.cycle());
    if (r.has_trials()) out += fmt::format(", trial {}", r.time().trial);
    return out + ">";
}

bool constructed(PyObject* self) {
    return reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder().holder_constructed();
}

/// Lets Python's garbage collector see the callbacks, which often refer to their run.
void visit_callbacks(PyHeapTypeObject* heap) {
    auto* type = &heap->ht_type;
    type->tp_flags |= Py_TPFLAGS_HAVE_GC;
    type->tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
        Py_VISIT(Py_TYPE(self));
        if (!constructed(self)) return 0;
        return py::cast<PythonRun&>(py::handle(self)).traverse(visit, arg);
    };
    type->tp_clear = [](PyObject* self) {
        if (constructed(self)) py::cast<PythonRun&>(py::handle(self)).clear();
        return 0;
    };
}

}  // namespace

void add_runs(py::module_& module) {
    const auto none = py::none();
    py::class_<PythonRun, std::shared_ptr<PythonRun>> run(module, "Run",
                                                          py::custom_type_setup(visit_callbacks));
    run.doc() = R"(A system in its world, run cycle by cycle. forage.open() makes one.

It may be read and changed between any two cycles. One thread at a time uses a run; several runs in several threads of Python use several cores, as
Python continues while a run runs. run["Process/Group"] is a Group, run["Process/Group:vm"] the array of a state, run["A to B"] a Connection; iterating
gives the names of the groups. As a context manager it closes itself. copy.copy() and pickle make runs in the same state, without callbacks.)";
    run.def("step", &PythonRun::step,
            "Runs one cycle. Raises RunError when a type or a module fails; such a run cannot continue.")
        .def(
            "run", &run_for, py::kw_only(), "cycles"_a = none, "seconds"_a = none, "trials"_a = none,
            "progress"_a = none, "trial_timeout"_a = 300.0, "on_timeout"_a = "truncate",
            R"(Runs for a number of cycles, seconds of the world or trials of the first robot, from now on; for 60 seconds without any of them.

Seconds end with the first cycle that completes them. What this cycle is longer shortens the next length in seconds, so calls in a row add up.
progress: True for a bar on the standard error, or a function that is called ten times per second with the fraction that is done, 0 to 1, and a text.
trial_timeout: seconds of the world, for a length in trials. on_timeout: "truncate" ends a trial that takes longer, so its row in `trials` is `truncated`,
    and begins the next one; "raise" raises RunError.

Raises InputError for two lengths, and for lengths that are negative or not finite. Ctrl-C raises KeyboardInterrupt between two cycles. After it, and after
what a callback raises, the run can continue.)")
        .def(
            "run_until", &run_until, "condition"_a, py::kw_only(), "cycles"_a = none, "seconds"_a = none,
            "trials"_a = none, "progress"_a = none, "trial_timeout"_a = 300.0, "on_timeout"_a = "truncate",
            R"(Runs until a condition such as "trial 30 || mean(Adaptive/discrepancy) < 0.1" holds, or a length is reached as in run().

Returns whether the condition holds. Without a length, the run ends with the condition only. Raises InputError for mistakes in the condition.)")
        .def(
            "on_cycle", &on_cycle, "callback"_a = none, "every"_a = 1,
            R"(Calls callback(run) between two cycles, whenever the number of completed cycles is a multiple of `every`.

It may read and change the run, but not run or close it. What it raises ends run() or step() and is raised there. Returns the callback; without a
callback, it is a decorator: @run.on_cycle(every=100).)")
        .def("remove", &remove, "what"_a,
             "Removes a callback, a probe or a manipulation. Raises ValueError for a callback that was not "
             "added.")
        .def("close", &PythonRun::close,
             "Frees the run, apart from what views and probes show. Other uses then raise RunError.")
        .def_property_readonly("closed", &PythonRun::closed, "Whether the run is closed.");
    const auto of_run = [&](const char* name, auto get, const char* doc) {
        run.def_property_readonly(
            name, [get](const PythonRun& self) { return std::invoke(get, self.use()); }, doc);
    };
    of_run("cycle", &Run::cycle, "The number of completed cycles, which is also the number of the next one.");
    of_run("seconds", &Run::seconds, "The time since the start, in seconds of the world.");
    of_run("seconds_per_cycle", &Run::seconds_per_cycle, "The length of a cycle, in seconds of the world.");
    of_run(
        "trial", [](const Run& r) { return r.time().trial; },
        "The running trial, from 1; 0 in a run without trials.");
    of_run("seed", &Run::seed, "The number that decides everything random.");
    of_run("divergence", &Run::divergence,
           "The first number that was NaN or infinite, in words; empty while all numbers are finite.");
    run.def_property_readonly(
           "groups", [](const PythonRun& self) { return py::tuple(py::cast(group_paths(self))); },
           R"(The names of all groups, "Process/Group".)")
        .def_property_readonly(
            "params", [](PythonRun& self) { return Parameters{self.shared_from_this()}; },
            "The parameters, by name, to read and to set.")
        .def_property_readonly("probes", &probes, "The probes, in the order in which they were added.")
        .def_property_readonly("manipulations", &manipulations,
                               "The manipulations, in the order in which they act.")
        .def_property_readonly(
            "trials", [](PythonRun& self) { return trials(self, 0); },
            R"(The finished trials of the first robot: a structured array with the columns of trials.csv (docs/reference/results.md).

Positions are in m, angles in rad, counter-clockwise from the x axis. `reached_target` stands for the outcome; NaN and -1 for what does not apply.
`truncated`: the trial was ended by trial_timeout, a time limit of the world or begin_trial(), not by the robot.)")
        .def("trials_of", &trials, "robot"_a, "The same of the robot with this number, from 0.")
        .def_property_readonly("measures", &measures,
                               "The present values of the measures: a structured array of shape () with a "
                               "field per measure, NaN where there is nothing to measure.")
        .def(
            "measure", &add_measure, "name"_a,
            R"(Takes a measure from the next cycle on, as an experiment file does: run.measure("first light", first="max(Bug/Light) > 0.5").

The keyword is one of success, duration, distance ("all" or "last 100"), first, trials, cycles (a condition), final, mean, minimum, maximum (a
quantity) and robot ("path length" and others, with of="NAME" of a robot that is not the first one); docs/reference/experiment.md explains them.)")
        .def(
            "move",
            [](PythonRun& self, const std::string& name, double x, double y, Seconds heading) {
                move(self.use(), name, x, y, heading);
            },
            "name"_a, "x"_a, "y"_a, "heading"_a = none,
            R"(Moves a robot or a movable object between two cycles to a place, in m, where it is at rest; a trial continues.

heading: in rad, counter-clockwise from the x axis; as it is without it.
Raises InputError without a world, for a name that it does not have, when something is at the place, and while the robot is being reset.)")
        .def(
            "begin_trial",
            [](PythonRun& self, std::optional<std::size_t> start, const std::string& robot) {
                begin_trial(self.use(), robot, start);
            },
            "start"_a = none, "robot"_a = "",
            R"(Ends the trial of a robot between two cycles, and begins the next one.

start: the number of a start pose of the world, from 0; the next one without it.
robot: its name; the first one without it.
Raises InputError.)")
        .def(
            "probe", &probe, "source"_a, "every"_a = 1,
            R"_(Records a source in memory, from the next cycle on, in each cycle whose number is a multiple of `every`. Returns a Probe.

source: "Process/Group", "Process/Group:state", some cells of it "Process/Group(2..4,1)", "mean(Process/Group)", or "Connection:weight".)_")
        .def("read", &read, "source"_a,
             R"(The numbers of any source in the last cycle, see probe(). It is a copy.)")
        .def(
            "digest", [](PythonRun& self) { return self.use().digest(); },
            "A short text that is equal for equal states of system and world: the state that `forage run "
            "--hash` prints.")
        .def(
            "restarted", &restart, "seed"_a,
            R"(A run as forage.open() returned this one, with another seed, at a small part of the time and memory of open().

What is constant is shared; parameters that were set since, probes and callbacks stay with this run, which does not change.)")
        .def(
            "save_state", &save, "file"_a = none,
            R"(Everything that the run needs to continue, in this program or another, with its probes, manipulations and measures. forage.resume() reads it.

file: a path, or a file that is open to write bytes. Without it, the bytes are returned.
Raises InputError for a run that was not opened from a file, and OSError when the file cannot be written.)")
        .def("__reduce__", &reduce)
        .def(
            "plot", &plot, "picture"_a, "format"_a = "png", "robot"_a = 0,
            R"_(Draws a picture of the run as it is now, as `forage run --plot` does. Returns a Picture, which notebooks show.

picture: "time:SOURCE" over time, "space:SOURCE" the last cycle or "space:SOURCE@100,200", "movie:SOURCE", "trajectory", "diagram" or
    "diagram:Process", "connection:NAME", "wiring:NAME" (docs/reference/expressions.md). Pictures over time show what a probe has recorded.
format: png, svg or pdf. A movie is always an animated gif.
robot: whose trajectory, from 0.

Raises InputError.)_")
        .def("diagram", &diagram, "process"_a = none, "format"_a = "svg",
             "Draws the processes, groups and connections of the system, or of one process. Returns a "
             "Picture.")
        .def(
            "film", &film, "file"_a, "groups"_a = std::vector<std::string>(),
            R"(Films the world and what the robots see, from the next cycle on: with run.film("robot.gif"): run.run(trials=1).

file: a name that ends with .gif, with .mp4 where ffmpeg is installed, or with .png for numbered pictures.
groups: sources whose activity is shown beside the world, such as "Process/Group".
Returns a Film, which is complete when it or the run is closed. Raises InputError, also without a world.)");
    run.def("__getitem__", &item, "name"_a)
        .def("__contains__", &run_has, "name"_a)
        .def("__iter__", [](const PythonRun& self) { return py::iter(py::cast(group_paths(self))); })
        .def("_ipython_key_completions_", &item_names)
        .def("__enter__", [](PythonRun& self) { return self.shared_from_this(); })
        .def("__exit__", [](PythonRun& self, const py::args&) { self.close(); })
        .def("_repr_html_", html("run"))
        .def("__repr__", [](const PythonRun& self) { return repr(self); });
    module.def("open", &open_run, "system"_a, py::kw_only(), "world"_a = none, "seed"_a = 1,
               "settings"_a = none, "plugins"_a = std::vector<Path>(), "threads"_a = 1, "lenient"_a = false,
               "noise"_a = true, "real_time_factor"_a = none, "observe"_a = none, "overwrite"_a = none,
               "on_nan"_a = "warn",
               R"(Opens a system, ready for its first cycle.

system: the path of the file, or a System.
world: the path of a world file (.world) in which its robots live; none without it.
seed: decides everything random.
settings: parameters by name, {"Process/Group.threshold": 0.5}, or texts as for `forage run --set`.
plugins: shared objects with types, and folders of them, in addition to FORAGE_PLUGIN_PATH and the folder "plugins" beside the system, if `forage trust` has trusted it.
threads: the largest number of threads that share a cycle, 1 to 1024; the numbers do not depend on it.
lenient: whether mistakes that the original accepts are warnings, not errors.
noise: whether motors and sensors are noisy.
real_time_factor: seconds of the world per second of the clock; the world's own rate without it.
observe: sources that will be read, such as "Bug/Light". With it, or with `overwrite`, the run computes nothing else but what these and modules need,
    which is faster and gives the same numbers; reading something else raises InputError. Without both, a run of 10,000 cycles or more issues
    InputWarning when it computes groups that nothing needs.
overwrite: groups that will be overwritten, which may also be read.
on_nan: what happens when a number becomes NaN or infinite for the first time: "warn" issues a RuntimeWarning at the end of run() or step(), "raise" raises
    RunError after that cycle, "ignore" does nothing; Run.divergence says where it was.

Raises InputError with all mistakes, and issues InputWarning.)");
    module.def(
        "resume",
        [](const py::object& state, const std::string& on_nan) { return resume_run(state, false, on_nan); },
        "state"_a, py::kw_only(), "on_nan"_a = "warn",
        R"(Continues a run from what Run.save_state() returned or wrote: bytes, a path, or a file that is open to read bytes.

on_nan: as for forage.open().

Plugins that the state names are loaded if `forage trust` has trusted their folder, or this program has loaded them before.
Raises InputError when the state is damaged, or the files of the system or the world have changed.)");
    module.def("_resumed", [](const py::bytes& state, const std::string& on_nan) {
        return resume_run(state, true, on_nan);
    });
}

}  // namespace forage::python
