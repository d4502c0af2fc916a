// Runs: opened, stepped, looked at while they last.
#include "tools/python/run.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/run/stop_condition.h"
#include "tools/python/group.h"

namespace forage::python {
namespace {

using Clock = std::chrono::steady_clock;
using namespace py::literals;

/// Signals such as that of Ctrl-C are looked for at this interval, and progress is shown at the other one.
constexpr auto between_signals = std::chrono::milliseconds(20);
constexpr auto between_reports = std::chrono::milliseconds(100);

/// Whether this is the thread in which Python handles signals.
bool in_main_thread() {
    const auto threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

/// Marks a run as running in this thread.
class PythonRun::Running {
  public:
    explicit Running(PythonRun& run) : run_(run) {
        run.use();
        if (run.runner_)
            throw engine::RunError("this run is running: a callback may read and change it, but not step it");
        run.runner_ = std::this_thread::get_id();
    }
    ~Running() { run_.runner_.reset(); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

  private:
    PythonRun& run_;
};

PythonRun::PythonRun(Run run) : run_(std::make_shared<Run>(std::move(run))) { run_->start(); }

std::shared_ptr<Run> PythonRun::owner() const {
    if (!run_) throw engine::RunError("this run is closed");
    if (runner_ && *runner_ != std::this_thread::get_id())
        throw engine::RunError("this run is running in another thread");
    return run_;
}

void PythonRun::close() {
    if (runner_) throw engine::RunError("this run is running: it cannot be closed");
    clear();
    run_.reset();
}

void PythonRun::on_cycle(py::object callback, std::uint64_t every) {
    use();
    callbacks_.push_back({std::move(callback), every});
}

void PythonRun::call_back() {
    const auto self = py::cast(shared_from_this());
    for (std::size_t i = 0; i < callbacks_.size(); ++i)  // a callback may add others
        if (run_->cycle() % callbacks_[i].every == 0) {
            const py::object function = callbacks_[i].function;
            function(self);
        }
}

void PythonRun::step() {
    const Running running(*this);
    {
        const py::gil_scoped_release others;
        run_->step();
    }
    if (!callbacks_.empty()) call_back();
}

bool PythonRun::advance(const RunLength& length, const py::object& progress) {
    const Running running(*this);
    const bool signals = in_main_thread(), shown = !progress.is_none();
    auto next_signals = Clock::now() + between_signals, next_report = Clock::now();
    const auto report = [&](const StopCondition& stop, const StopOrigin& origin) {
        progress(stop.fraction_done(*run_, origin), stop.progress(*run_));
    };
    const auto due = [&] {
        return std::any_of(callbacks_.begin(), callbacks_.end(),
                           [&](const Callback& c) { return run_->cycle() % c.every == 0; });
    };
    const auto after_cycle = [&](const StopCondition& stop, const StopOrigin& origin) {
        if (due()) {
            const py::gil_scoped_acquire python;
            call_back();
        }
        if (!signals && !shown) return;
        const auto now = Clock::now();
        if (signals && now >= next_signals) {
            next_signals = now + between_signals;
            const py::gil_scoped_acquire python;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        }
        if (shown && now >= next_report) {
            next_report = now + between_reports;
            const py::gil_scoped_acquire python;
            report(stop, origin);
        }
    };
    EarlyEnd end;
    {
        const py::gil_scoped_release others;
        end = run_->advance(length, after_cycle);
    }
    if (shown) progress(1.0, "");
    if (!end.timeout.empty()) throw engine::RunError(end.timeout);
    return end.held;
}

py::object PythonRun::view_of(int group, int state, const std::function<py::object()>& make) {
    auto& view = views_[{group, state}];
    if (!view) view = make();
    return view;
}

int PythonRun::traverse(visitproc visit, void* arg) const {
    for (const auto& c : callbacks_) Py_VISIT(c.function.ptr());
    return 0;
}

namespace {

std::string text_of(const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    return py::str(value);
}

std::vector<std::string> assignments(const py::object& settings) {
    std::vector<std::string> out;
    if (py::isinstance<py::dict>(settings))
        for (const auto& [name, value] : settings.cast<py::dict>())
            out.push_back(fmt::format("{}={}", name.cast<std::string>(), text_of(value)));
    else if (!settings.is_none())
        for (const auto& text : settings) out.push_back(text.cast<std::string>());
    return out;
}

using Path = std::filesystem::path;
using Names = std::optional<std::vector<std::string>>;

std::shared_ptr<PythonRun> open_run(const Path& system, const std::optional<Path>& world, std::uint64_t seed,
                                    const py::object& settings, const std::vector<Path>& plugins, int threads,
                                    bool lenient, bool noise, std::optional<double> real_time_factor,
                                    const Names& observe, const Names& overwrite) {
    OpenOptions options{.world = world ? world->string() : std::string(),
                        .seed = seed,
                        .settings = assignments(settings),
                        .threads = threads,
                        .lenient = lenient,
                        .noise = noise,
                        .real_time_factor = real_time_factor,
                        .observe = observe,
                        .overwrite = overwrite};
    for (const auto& p : plugins) options.plugins.push_back(p.string());
    Diagnostics warnings;
    std::shared_ptr<PythonRun> run;
    {
        const py::gil_scoped_release others;
        run = std::make_shared<PythonRun>(open(system.string(), options, &warnings));
    }
    warn(warnings);
    return run;
}

RunLength length_of(std::optional<std::uint64_t> cycles, std::optional<double> seconds,
                    std::optional<std::uint64_t> trials, double trial_timeout) {
    return {.cycles = cycles, .seconds = seconds, .trials = trials, .trial_timeout = trial_timeout};
}

std::string repr(const PythonRun& run) {
    if (run.closed()) return "<forage.Run, closed>";
    const Run& r = run.use();
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
    py::class_<PythonRun, std::shared_ptr<PythonRun>> run(module, "Run",
                                                          py::custom_type_setup(visit_callbacks), R"(
        A system in its world, run cycle by cycle. `forage.open` makes one.

        It may be read and changed between any two cycles. A run is used by one thread at a time; any number of runs
        may exist, and runs in several threads of Python use several cores. As a context manager it closes itself.)");
    run.def("step", &PythonRun::step, R"(
        Runs one cycle: groups, modules and connections, and then the world.

        Raises RunError when a type or a module fails; such a run cannot go on.)")
        .def(
            "run",
            [](PythonRun& self, std::optional<std::uint64_t> cycles, std::optional<double> seconds,
               std::optional<std::uint64_t> trials, const py::object& progress, double trial_timeout) {
                self.advance(length_of(cycles, seconds, trials, trial_timeout), progress);
            },
            py::kw_only(), "cycles"_a = py::none(), "seconds"_a = py::none(), "trials"_a = py::none(),
            "progress"_a = py::none(), "trial_timeout"_a = 300.0)
        .def("on_cycle", &PythonRun::on_cycle, "callback"_a, "every"_a = 1)
        .def("close", &PythonRun::close)
        .def_property_readonly("closed", &PythonRun::closed)
        .def_property_readonly("cycle", [](const PythonRun& self) { return self.use().cycle(); })
        .def_property_readonly("seconds", [](const PythonRun& self) { return self.use().seconds(); })
        .def("digest", [](PythonRun& self) { return self.use().digest(); })
        .def("__getitem__", [](PythonRun& self, const std::string& name) { return find_group(self, name); })
        .def("__enter__", [](PythonRun& self) { return self.shared_from_this(); })
        .def("__exit__", [](PythonRun& self, const py::args&) { self.close(); })
        .def("__repr__", &repr);
    module.def("open", &open_run, "system"_a, py::kw_only(), "world"_a = py::none(), "seed"_a = 1,
               "settings"_a = py::none(), "plugins"_a = std::vector<Path>(), "threads"_a = 1,
               "lenient"_a = false, "noise"_a = true, "real_time_factor"_a = py::none(),
               "observe"_a = py::none(), "overwrite"_a = py::none());
}

}  // namespace forage::python
