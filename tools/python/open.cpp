// Runs: opened from files, resumed from a saved state, and the methods that Python has for them.
#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tools/python/group.h"
#include "tools/python/probe.h"
#include "tools/python/run.h"
#include "tools/python/tables.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;
using Names = std::optional<std::vector<std::string>>;
using Count = std::optional<std::uint64_t>;
using Seconds = std::optional<double>;

std::shared_ptr<PythonRun> open_run(const Path& system, const std::optional<Path>& world, std::uint64_t seed,
                                    const py::object& settings, const std::vector<Path>& plugins, int threads,
                                    bool lenient, bool noise, Seconds real_time_factor, const Names& observe,
                                    const Names& overwrite) {
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

std::string file_content(const std::string& path) {
    auto in = open_file(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Resumes a run from what save() wrote: bytes, a file that is open to be read, or the path of a file.
std::shared_ptr<PythonRun> resume_run(const py::object& state) {
    std::string bytes;
    if (py::isinstance<py::bytes>(state))
        bytes = state.cast<std::string>();
    else if (py::hasattr(state, "read"))
        bytes = state.attr("read")().cast<std::string>();
    else
        bytes = file_content(state.cast<Path>().string());
    const py::gil_scoped_release others;
    return std::make_shared<PythonRun>(resume(bytes));
}

py::object save(PythonRun& self, const py::object& file) {
    const std::string bytes = save_state(self.use());
    if (file.is_none()) return py::bytes(bytes);
    if (py::hasattr(file, "write"))
        file.attr("write")(py::bytes(bytes));
    else
        try {
            write_durably(file.cast<Path>().string(), bytes);
        } catch (const std::runtime_error& e) {
            PyErr_SetString(PyExc_OSError, e.what());
            throw py::error_already_set();
        }
    return py::none();
}

py::tuple reduce(PythonRun& self) {
    return py::make_tuple(py::module_::import("forage._state").attr("resumed"),
                          py::make_tuple(save(self, py::none())));
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
    return {.cycles = cycles, .seconds = seconds, .trials = trials, .trial_timeout = trial_timeout};
}

void run_for(PythonRun& self, Count cycles, Seconds seconds, Count trials, const py::object& progress,
             double trial_timeout) {
    self.advance(length_of(cycles, seconds, trials, trial_timeout), reporter(progress));
}

bool run_until(PythonRun& self, const std::string& condition, Count cycles, Seconds seconds, Count trials,
               const py::object& progress, double trial_timeout) {
    RunLength length = length_of(cycles, seconds, trials, trial_timeout);
    length.until = {condition};
    return self.advance(length, reporter(progress));
}

py::array read(PythonRun& self, const std::string& source) {
    Diagnostics diagnostics;
    const auto found = observe::find_source(self.use().layout(), source, "read", diagnostics);
    throw_errors(diagnostics);
    return array_of(self.use().read(source), shape_of(found->what()));
}

std::vector<std::string> group_paths(const PythonRun& self) {
    std::vector<std::string> out;
    for (const auto& g : self.use().layout().groups) out.push_back(g.path);
    return out;
}

bool has_group(const PythonRun& self, const std::string& path) {
    return std::ranges::any_of(self.use().layout().groups, [&](const auto& g) { return g.path == path; });
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
    if (self.closed()) return "<forage.Run, closed>";
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
    run.def("step", &PythonRun::step)
        .def("run", &run_for, py::kw_only(), "cycles"_a = none, "seconds"_a = none, "trials"_a = none,
             "progress"_a = none, "trial_timeout"_a = 300.0)
        .def("run_until", &run_until, "condition"_a, py::kw_only(), "cycles"_a = none, "seconds"_a = none,
             "trials"_a = none, "progress"_a = none, "trial_timeout"_a = 300.0)
        .def("on_cycle", &on_cycle, "callback"_a = none, "every"_a = 1)
        .def("remove", &remove, "what"_a)
        .def("close", &PythonRun::close)
        .def_property_readonly("closed", &PythonRun::closed);
    run.def_property_readonly("cycle", [](const PythonRun& self) { return self.use().cycle(); })
        .def_property_readonly("seconds", [](const PythonRun& self) { return self.use().seconds(); })
        .def_property_readonly("seconds_per_cycle",
                               [](const PythonRun& self) { return self.use().seconds_per_cycle(); })
        .def_property_readonly("trial", [](const PythonRun& self) { return self.use().time().trial; })
        .def_property_readonly("seed", [](const PythonRun& self) { return self.use().seed(); })
        .def_property_readonly("divergence", [](const PythonRun& self) { return self.use().divergence(); })
        .def_property_readonly("groups",
                               [](const PythonRun& self) { return py::tuple(py::cast(group_paths(self))); })
        .def_property_readonly("params", [](PythonRun& self) { return Parameters{self.shared_from_this()}; })
        .def_property_readonly("probes", &probes)
        .def_property_readonly("manipulations", &manipulations)
        .def_property_readonly("trials", [](PythonRun& self) { return trials(self, 0); })
        .def("trials_of", &trials, "robot"_a)
        .def_property_readonly("measures", &measures)
        .def("measure", &add_measure, "name"_a)
        .def("probe", &probe, "source"_a, "every"_a = 1)
        .def("read", &read, "source"_a)
        .def("digest", [](PythonRun& self) { return self.use().digest(); })
        .def("save_state", &save, "file"_a = none)
        .def("__reduce__", &reduce);
    run.def("__getitem__", [](PythonRun& self, const std::string& path) { return find_group(self, path); })
        .def("__contains__", &has_group)
        .def("__enter__", [](PythonRun& self) { return self.shared_from_this(); })
        .def("__exit__", [](PythonRun& self, const py::args&) { self.close(); })
        .def("__repr__", [](const PythonRun& self) { return repr(self); });
    module.def("open", &open_run, "system"_a, py::kw_only(), "world"_a = none, "seed"_a = 1,
               "settings"_a = none, "plugins"_a = std::vector<Path>(), "threads"_a = 1, "lenient"_a = false,
               "noise"_a = true, "real_time_factor"_a = none, "observe"_a = none, "overwrite"_a = none);
    module.def("resume", &resume_run, "state"_a);
}

}  // namespace forage::python
