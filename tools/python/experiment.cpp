// Experiments and sweeps. forage/_experiment.py makes tables of what is here.

#include "tools/api/experiment/experiment.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <variant>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "core/base/cores.h"
#include "core/base/sequence.h"
#include "core/run/experiment/tables.h"
#include "tools/python/tables.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

/// Shows the progress of an experiment, and ends it after what Python raises: a signal such as that of
/// Ctrl-C, or an exception of the function that shows it. Used without the GIL.
class Watch {
  public:
    explicit Watch(py::object progress) : progress_(std::move(progress)) {}

    ExperimentCallbacks callbacks() {
        return {.progress = [this](const auto& p) { look(p); },
                .interrupted = [this] { return ended_.load(); }};
    }
    /// Throws what ended the experiment, if anything did.
    void rethrow() const {
        if (raised_) std::rethrow_exception(raised_);
    }

  private:
    using Clock = std::chrono::steady_clock;

    void look(const ExperimentCallbacks::Progress& p) {
        if (ended_) return;
        const py::gil_scoped_acquire python;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (const auto now = Clock::now(); !progress_.is_none() && now >= next_) {
                next_ = now + std::chrono::milliseconds(100);
                progress_(p.done, fmt::format("{}/{} runs", p.finished, p.all));
            }
        } catch (...) {
            raised_ = std::current_exception();
            ended_ = true;
        }
    }

    py::object progress_;
    Clock::time_point next_ = Clock::now();
    std::exception_ptr raised_;
    std::atomic<bool> ended_ = false;
};

/// The columns of the table of results: their names and values.
py::list columns_of(const ExperimentOutcome& outcome) {
    py::list out;
    for (const auto& column : results_columns(outcome.experiment, outcome.runs, outcome.results)) {
        const std::size_t sweep = out.size() - 1;  // behind the names of the runs
        py::list values;
        for (std::size_t run = 0; run < outcome.runs.size(); ++run)
            if (sweep < outcome.experiment.sweeps.size())  // texts, which may become integers
                values.append(outcome.runs.values(outcome.runs.combination(run))[sweep]);
            else
                std::visit([&](const auto& value) { values.append(value(run)); }, column.values);
        out.append(py::make_tuple(column.name, values));
    }
    return out;
}

/// An experiment: the path of its file, or what code describes.
struct PythonExperiment {
    std::variant<std::string, model::Experiment> what;
    std::vector<std::string> plugins;

    /// For one part, in a process that shares the directory with others.
    PreparedExperiment prepare(const std::string& directory) const {
        Diagnostics found;
        const auto prepare = [&](const auto& w) { return prepare_part(w, directory, plugins, found); };
        return *checked(found, std::visit(prepare, what));
    }
};

/// The number of runs at a time.
int jobs_of(int jobs) {
    if (jobs < 0)
        throw InputError(fmt::format("jobs: {} is not a number of runs at a time", jobs),
                         "0 is one per core");
    return jobs > 0 ? jobs : cores();
}

py::list run_all(const PythonExperiment& self, const std::string& directory, int jobs, bool fresh,
                 py::object progress) {
    Watch watch(std::move(progress));
    const ExperimentSettings settings{.directory = directory,
                                      .plugins = self.plugins,
                                      .jobs = jobs_of(jobs),
                                      .fresh = fresh,
                                      .callbacks = watch.callbacks()};
    ExperimentOutcome outcome;
    {
        const py::gil_scoped_release others;
        outcome = std::visit([&](const auto& what) { return experiment(what, settings); }, self.what);
    }
    watch.rethrow();
    warn(outcome.warnings);
    return columns_of(outcome);
}

/// Executes one part of an experiment, as `forage experiment --shard` does, in a worker of an executor.
void run_shard(const PythonExperiment& self, const std::string& directory, bool fresh, std::size_t number,
               std::size_t of) {
    Watch watch{py::none()};
    const py::gil_scoped_release others;
    auto prepared = self.prepare(directory);
    run_part(prepared, Shard{number, of}, 1, fresh, watch.callbacks());
    watch.rethrow();
}

/// The round of an experiment that parts work on, and how many of its runs have no result yet.
std::pair<std::size_t, std::size_t> missing_runs(const PythonExperiment& self, const std::string& directory) {
    const py::gil_scoped_release others;
    auto prepared = self.prepare(directory);
    const PartResults found = read_results(prepared);
    return {prepared.round, found.results.size() - found.finished() - found.failed()};
}

std::vector<std::string> values_of(const py::iterable& values) {
    return collected(values, [](const auto& value) { return text_of(value); });
}

/// The sweeps in a dictionary: each key is a parameter, or a tuple of parameters whose values are tuples,
/// because they vary together.
std::vector<model::Sweep> sweeps_of(const py::dict& values) {
    std::vector<model::Sweep> out;
    std::size_t axis = 0;
    for (const auto& [key, list] : values) {
        const bool together = py::isinstance<py::tuple>(key);
        const py::tuple names = together ? key.cast<py::tuple>() : py::make_tuple(key);
        const std::size_t first = out.size();
        for (const auto& name : names) out.push_back({{name.cast<std::string>()}, {}, {}, axis});
        if (py::isinstance<py::str>(list) || !py::isinstance<py::iterable>(list))
            throw py::type_error(
                fmt::format("sweep: the values of '{}' are not a list", out[first].parameter.text));
        for (const auto& value : list) {
            const auto texts = values_of(together ? value.cast<py::tuple>() : py::make_tuple(value));
            if (texts.size() != names.size())
                throw InputError(
                    fmt::format("sweep: {} values are given for {} parameters that vary together",
                                texts.size(), names.size()));
            for (std::size_t i = 0; i < texts.size(); ++i)
                out[first + i].values.push_back({.text = texts[i]});
        }
        for (std::size_t i = first; i < out.size(); ++i)
            if (out[i].values.empty())
                throw InputError(fmt::format("sweep: '{}' has no values", out[i].parameter.text));
        ++axis;
    }
    return out;
}

/// A sweep with the arguments of forage.sweep().
PythonExperiment make_sweep(const py::kwargs& given) {
    std::vector<std::string> plugins;
    model::Experiment e;
    take(given, "system", e.path), take(given, "world", e.world), take(given, "plugins", plugins);
    take(given, "seeds", e.seeds), take(given, "noise", e.noise), take(given, "until", e.until.text);
    take(given, "real_time_factor", e.real_time_factor), take(given, "trial_timeout", e.trial_timeout);
    std::optional<std::int64_t> cycles, trials;
    take(given, "cycles", cycles), take(given, "seconds", e.seconds), take(given, "trials", trials);
    e.cycles = count_of("cycles", cycles), e.trials = count_of("trials", trials);
    e.systems = {{e.path}}, e.sweeps = sweeps_of(given["values"]);
    for (const auto& text : assignments(given["settings"])) e.settings.push_back({text});
    Diagnostics diagnostics;
    for (const auto& [name, kind] : given["measures"].cast<py::dict>())
        e.measures.push_back(measure_of(name.cast<std::string>(), kind.cast<py::dict>(), diagnostics));
    for (const auto& [kind, options] : given["adaptations"].cast<py::dict>()) {
        if (e.adaptation)
            diagnostics.error({}, "halving and confidence exclude each other", "leave out one of them");
        e.adaptation = adaptation_of(kind.cast<std::string>(), options.cast<py::dict>(), diagnostics);
    }
    model::check_adaptation(e, diagnostics);
    if (e.seeds.empty())
        diagnostics.error({}, "sweep: there is no seed", "seeds=5 stands for the seeds 1 to 5");
    throw_errors(diagnostics);
    return {std::move(e), std::move(plugins)};
}

/// The runs of a sweep, after all mistakes in them were reported: (name, values, seed, settings) of each.
py::list planned(const PythonExperiment& self) {
    const RunPlan runs = warned([&](Diagnostics* warnings) {
        const py::gil_scoped_release others;
        return forage::plan(std::get<model::Experiment>(self.what), self.plugins, warnings);
    });
    py::list out;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const PlannedRun run = runs[i];
        py::list settings;
        for (const auto& s : run.spec.input.settings) settings.append(s.text);
        out.append(py::make_tuple(run.name, run.values, run.spec.input.seed, settings));
    }
    return out;
}

}  // namespace

void add_experiments(py::module_& module) {
    py::class_<PythonExperiment>(module, "_Experiment")
        .def(py::init([](const std::string& file, const std::vector<std::string>& plugins) {
                 return PythonExperiment{file, plugins};
             }),
             "file"_a, "plugins"_a)
        .def(py::init(&make_sweep))
        .def("plan", &planned)
        .def("part", &run_shard)
        .def("missing", &missing_runs)
        .def("run", &run_all);
    module.def("_jobs", &jobs_of);
}

}  // namespace forage::python
