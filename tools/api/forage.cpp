#include "tools/api/forage/forage.h"

#include <algorithm>

#include "core/base/named_file.h"
#include "core/plugin/search.h"
#include "core/run/experiment/tables.h"
#include "core/run/path_recorder.h"
#include "core/run/result_names.h"
#include "tools/api/experiment/experiment.h"
#include "tools/api/experiment/results.h"
#include "tools/api/open/prepare.h"
#include "tools/api/open/program_types.h"
#include "tools/api/open/saved_run.h"

namespace forage {
namespace {

void declare(const OpenOptions& options, Run& run, Diagnostics& diagnostics) {
    for (const auto& text : options.observe.value_or(std::vector<std::string>()))
        if (const auto source = observe::find_source(run.layout(), text, "observe", diagnostics))
            source->declare(run.demand());
    for (const auto& text : options.overwrite.value_or(std::vector<std::string>()))
        if (const auto column = observe::find_column(run.layout(), text, "overwrite", diagnostics))
            run.demand().overwrite_group(column->group);
}

/// Adds the observers that every run of open() has.
void add_recorders(Run& run, bool paths) {
    const Environment* world = run.environment();
    if (!world) return;
    for (std::size_t i = 0; i < world->robot_names().size(); ++i) {
        run.add(std::make_unique<TrialRecorder>(*world, i, run.layout(), trials_file()));
        if (paths) run.add(std::make_unique<PathRecorder>(*world, i, trajectory_file()));
    }
}

Run make_run(model::System system, Registry types, std::unique_ptr<Environment> environment,
             const OpenOptions& options, Diagnostics& diagnostics) {
    const bool everything = options.compute_everything && !options.observe && !options.overwrite;
    auto run = Run::make(std::move(system), std::move(types), std::move(environment),
                         {.seed = options.seed, .threads = options.threads, .compute_everything = everything},
                         diagnostics);
    if (run) declare(options, *run, diagnostics);
    throw_errors(diagnostics);
    add_recorders(*run, options.paths);
    return std::move(*run);
}

/// Executes the runs of an experiment.
ExperimentOutcome carried_out(std::optional<PreparedExperiment> prepared, const ExperimentSettings& settings,
                              Diagnostics& diagnostics) {
    throw_errors(diagnostics);
    auto results = run_experiment(*prepared, settings.jobs, settings.fresh, settings.callbacks);
    ExperimentOutcome out{.experiment = std::move(prepared->experiment),
                          .runs = std::move(prepared->runs),
                          .results = std::move(results).value_or(std::vector<RunResult>()),
                          .results_file = prepared->results_file(),
                          .summary_file = prepared->summary_file(),
                          .warnings = std::move(diagnostics)};
    if (out.results.empty()) return out;
    if (const auto diverged = divergence_summary(out.runs, out.results); !diverged.empty())
        out.warnings.warning({}, diverged);
    append(&out.warnings, warnings_of(out.runs, out.results));
    return out;
}

}  // namespace

void OpenOptions::checkpoint(Archive& archive) {
    archive(world, seed, settings, plugins, threads, lenient, noise, real_time_factor, compute_everything,
            observe, overwrite, paths);
}

Registry types(const std::vector<std::string>& plugins) {
    Diagnostics diagnostics;
    Registry out = shipped_types();
    plugin::add(plugin::load(plugin::find(plugins, {}, {}, diagnostics), plugin::Use::read, out, diagnostics),
                out);
    throw_errors(diagnostics);
    return out;
}

Run open(const std::string& system, const std::string& text, const OpenOptions& options,
         Diagnostics* warnings, const InputFiles* resumed_files) {
    RunSpec spec;
    RunInput& input = spec.input;
    input.system = system, input.text = text, input.world = options.world, input.seed = options.seed,
    input.plugins = options.plugins;
    input.lenient = options.lenient, input.noise = options.noise,
    input.real_time_factor = options.real_time_factor;
    for (const auto& setting : options.settings) input.settings.push_back({setting});
    if (resumed_files) input.resumed_files = *resumed_files;
    Diagnostics diagnostics;
    const Sources sources = read_sources(input, diagnostics);
    auto loaded = checked(diagnostics, assemble(sources, input, diagnostics));
    auto types = program_types_of(loaded->system);
    Run out = make_run(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                       options, diagnostics);
    out.title = run_title(input);
    out.opened_as = origin_of(system, text, options, input_files(spec, sources), std::move(types));
    append(warnings, diagnostics);
    return out;
}

Run open(const std::string& system, const OpenOptions& options, Diagnostics* warnings) {
    return open(system, {}, options, warnings);
}

Run open(model::System system, Registry types, std::unique_ptr<Environment> environment,
         const OpenOptions& options) {
    Diagnostics diagnostics;
    return make_run(std::move(system), std::move(types), std::move(environment), options, diagnostics);
}

Run restarted(const Run& run, std::uint64_t seed) {
    Run out = run.restarted(seed);
    add_recorders(out, std::ranges::any_of(run.observers(), [](const auto& observer) {
                      return dynamic_cast<const PathRecorder*>(observer.get()) != nullptr;
                  }));
    set_origin(out, run);
    return out;
}

RunOutcome run(const RunSpec& spec, const RunCallbacks& callbacks) {
    Diagnostics diagnostics;
    const Sources sources = read_sources(spec.input, diagnostics);
    auto prepared = prepare(sources, spec, diagnostics);
    if (prepared && !spec.directory.empty()) clear_directory(spec, diagnostics);
    throw_errors(diagnostics);
    begin_files(*prepared);
    return run_to_end(*prepared, callbacks);
}

std::vector<std::string> draw(const std::string& from, const std::vector<std::string>& plots,
                              const std::string& directory, const std::string& format,
                              const std::vector<std::string>& where, const std::string& layout,
                              const std::string& width) {
    Diagnostics diagnostics;
    std::vector<std::string> out;
    std::optional<plot::FigureLayout> panels;
    if (!layout.empty()) panels = plot::parse_layout(layout, diagnostics);
    std::optional<plot::FigureWidth> size;
    if (!width.empty()) size = plot::parse_width(width, diagnostics);
    const auto picture = plot::format_of("x." + format);
    if (!picture) diagnostics.error({}, "'" + format + "' is not a format of pictures", "png, svg or pdf");
    try {
        Results results = open_results(from);
        if (picture && !diagnostics.failed())
            out = draw(results, plots, directory, *picture, diagnostics, where, panels, size);
    } catch (const FileError& e) {
        report(e, diagnostics);
    }
    throw_errors(diagnostics);
    return out;
}

ExperimentOutcome experiment(const std::string& file, const ExperimentSettings& settings) {
    Diagnostics diagnostics;
    return carried_out(prepare_experiment(file, settings.directory, settings.plugins, diagnostics), settings,
                       diagnostics);
}

ExperimentOutcome experiment(model::Experiment wanted, const ExperimentSettings& settings) {
    Diagnostics diagnostics;
    return carried_out(
        prepare_experiment(std::move(wanted), settings.directory, settings.plugins, diagnostics), settings,
        diagnostics);
}

RunPlan plan(model::Experiment wanted, const std::vector<std::string>& plugins, Diagnostics* warnings) {
    Diagnostics diagnostics;
    auto planned = plan_experiment(std::move(wanted), {}, plugins, diagnostics);
    throw_errors(diagnostics);
    append(warnings, diagnostics);
    return std::move(planned->runs);
}

}  // namespace forage
