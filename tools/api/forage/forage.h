// Forage inside another program: open a system with its world, step it, read, record and change it.
//
//     auto run = forage::open("dac_foraging.iqr", {.world = "basic_arena.world", .seed = 1});
//     const auto& light = run.record("Bug/Light");
//     run.until({.trials = 30});
//     std::cout << light.rows().rowwise().mean() << '\n';
//     for (const auto& trial : run.trials().finished)
//         std::cout << trial.number << ' ' << trial.reached_target << '\n';
//
// The public interface is this header and what it includes: forage::Run, forage::Observer,
// forage::Environment, the compiled system (forage::engine::Simulation), systems as values (forage::model,
// "core/model/build.h") and forage::Registry. It keeps its meaning within the versions that
// find_package(Forage VERSION) accepts.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/build.h"
#include "core/run/experiment/runs.h"
#include "core/run/prepared_run.h"
#include "core/run/run.h"
#include "core/types/registry.h"

namespace forage {

struct OpenOptions {
    std::string world = {};                  ///< file of the world in which the robots live; none when empty
    std::uint64_t seed = 1;                  ///< decides everything random
    std::vector<std::string> settings = {};  ///< "Process/Group.parameter=value", as for `forage run --set`
    /// Shared objects and folders of them, in addition to FORAGE_PLUGIN_PATH and the trusted folder "plugins"
    /// beside the system.
    std::vector<std::string> plugins = {};
    int threads = 1;       ///< largest number of threads; the results do not depend on it
    bool lenient = false;  ///< whether mistakes that the original accepts are warnings, not errors
    bool noise = true;     ///< whether motors and sensors are noisy
    /// Seconds of the world per second of the clock. Empty for the world's own rate.
    std::optional<double> real_time_factor = {};
    /// Whether all groups are computed, so that everything can be read and changed at any time. Otherwise the
    /// run computes only what modules and the observers that are added before the first cycle read: faster,
    /// with the same numbers.
    bool compute_everything = true;
    /// Sources such as "Bug/Light" that will be read, and groups that will be overwritten as well. When
    /// either is given, the run computes nothing else but what observers and modules read.
    std::optional<std::vector<std::string>> observe = {}, overwrite = {};
    bool paths = false;  ///< whether the paths of the robots are kept, for the picture "trajectory"

    void checkpoint(Archive& archive);
};

/// Opens a system file (.iqr) with its world. The run is ready for step(). Throws InputError. Warnings about
/// the files are added to `warnings`, if it is not null.
Run open(const std::string& system, const OpenOptions& options = {}, Diagnostics* warnings = nullptr);
/// Opens a system that was built in code, with the types that it uses, in an environment of the caller, which
/// may be null. Throws InputError. The options world, plugins, lenient, noise and real_time_factor have no
/// effect.
Run open(model::System system, Registry types, std::unique_ptr<Environment> environment = nullptr,
         const OpenOptions& options = {});

/// A run as open() returned it, with another seed, at a small part of the time and memory of open(): it
/// shares with `run` what is constant (Run::restarted()). Parameters that were set since, recordings and
/// other observers stay with `run`, which does not change. Throws InputError for a run in an environment of
/// the caller that cannot be restarted.
Run restarted(const Run& run, std::uint64_t seed);

/// Everything that a run needs to continue in this program or another: how open() was called, the digests of
/// its files, its recordings in memory, manipulations and measures, and its state. Throws InputError for a
/// run that was not opened from a file or has other observers, and engine::RunError for modules of a type
/// that does not declare what it keeps.
std::string save_state(Run& run);
/// Opens the run again and continues from the state. Plugins that the state names are loaded when their
/// folder is trusted (`forage trust`), when this program has loaded them before, or when the state is
/// `trusted`. Throws InputError when its files have changed or cannot be read, CheckpointError and
/// ArchiveError when `state` is not one or does not fit.
Run resume(std::string_view state, bool trusted = false);

/// Runs what `spec` describes to its end, and writes recordings, pictures and tables into spec.directory, as
/// `forage run` does. RunOutcome::problems says what failed during the run. Throws InputError for mistakes in
/// the spec and its files, and std::runtime_error when the directory cannot be written to.
RunOutcome run(const RunSpec& spec, const RunCallbacks& callbacks = {});

/// Draws pictures, as `forage plot` does, of a directory of results, a recording (.csv, .npy, .npz, .h5) or a
/// system file (.iqr): `plots` such as "time:Process/Group" and "trajectory", or all that are possible when
/// there are none. They are written into `directory`, or beside the results when it is empty, in a format
/// that is png, svg or pdf. Of an experiment, `where` ("seed=1") chooses runs. Returns the names of the
/// files. With a `layout` such as "2x3", the pictures are panels a, b, c, ... of one figure, row by row. With
/// a `width` such as "85mm" or "600px", they are enlarged or reduced to it. Throws InputError.
std::vector<std::string> draw(const std::string& from, const std::vector<std::string>& plots = {},
                              const std::string& directory = {}, const std::string& format = "png",
                              const std::vector<std::string>& where = {}, const std::string& layout = {},
                              const std::string& width = {});

/// Draws a picture of a run as it is now, such as "time:Process/Group", "diagram" and "trajectory", as
/// `forage run --plot` does. Returns the content of a file in a format that is png, svg or pdf. Pictures over
/// time show what was recorded in memory (Run::record()); "space:SOURCE" without a recording shows the last
/// cycle. A trajectory is that of one robot, and needs OpenOptions::paths. Throws InputError. Warnings are
/// added to `warnings`, if it is not null.
std::string draw(Run& run, const std::string& picture, const std::string& format = "png",
                 std::size_t robot = 0, Diagnostics* warnings = nullptr);
/// Films the world of a run, from the next cycle on, until finish_film(): into a file that ends with .gif or,
/// where ffmpeg is installed, .mp4, or into numbered pictures for a name that ends with .png. The activity of
/// `groups`, which are sources, is shown beside the world. Throws InputError.
Observer& film(Run& run, const std::string& file, const std::vector<std::string>& groups = {});
/// Completes a film of a run and removes it from the run. Returns the number of its frames. Throws
/// std::runtime_error when the file cannot be written.
std::size_t finish_film(Run& run, Observer& film);

struct ExperimentSettings {
    /// For the results. Empty for forage-out/ and the name of the experiment's file.
    std::string directory = {};
    std::vector<std::string> plugins = {};  ///< as in OpenOptions
    int jobs = 0;                           ///< number of runs at a time; 0: one per core
    bool fresh = false;                     ///< whether runs that were finished before are repeated
    ExperimentCallbacks callbacks = {};
};
struct ExperimentOutcome {
    model::Experiment experiment;
    RunPlan runs;
    std::vector<RunResult> results;  ///< one per run, in the same order; empty when it was interrupted
    std::string results_file, summary_file;
    Diagnostics warnings;  ///< about the files and the runs
};
/// Runs an experiment file with all its seeds and swept values, as `forage experiment` does, and writes its
/// tables. Throws InputError.
ExperimentOutcome experiment(const std::string& file, const ExperimentSettings& settings);
inline ExperimentOutcome experiment(const std::string& file, const std::string& directory = {},
                                    int jobs = 0) {
    return experiment(file, ExperimentSettings{.directory = directory, .jobs = jobs});
}
/// Runs an experiment that was described in code; settings.directory is not empty. Throws InputError.
ExperimentOutcome experiment(model::Experiment experiment, const ExperimentSettings& settings);
/// The runs of an experiment that was described in code. Nothing is run or written. Throws InputError for all
/// mistakes in them. Warnings are added to `warnings`, if it is not null.
RunPlan plan(model::Experiment experiment, const std::vector<std::string>& plugins = {},
             Diagnostics* warnings = nullptr);

/// The types that ship with Forage, and those of `plugins`: shared objects and folders of them. Throws
/// InputError.
Registry types(const std::vector<std::string>& plugins = {});

}  // namespace forage
