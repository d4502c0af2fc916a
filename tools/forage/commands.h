// The commands of the program. Each takes its options and returns the exit status: 0 fine, 1 the run failed,
// 2 bad usage or bad input.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/api/prepare.h"

namespace forage::tool {

enum ExitStatus { fine = 0, run_failed = 1, bad_input = 2 };

struct RunOptions {
    RunOptions() { spec.directory = "forage-out"; }
    RunSpec spec;
    bool real_time = false;  ///< no faster than the clock
    bool quiet = false;
};

struct ResumeOptions {
    std::string path;  ///< a directory of results, or a checkpoint in it
    int threads = 0;   ///< 0: as many as before
    bool quiet = false;
};
/// Makes options of the arguments of `forage run`.
using RunParser = std::function<RunOptions(const std::vector<std::string>& arguments)>;

struct ConvertOptions {
    std::string input, output;         ///< .iqr or .iqrProcess, both
    std::vector<std::string> imports;  ///< process files to add
    std::string extract;               ///< name or id of a process to write on its own
    std::vector<std::string> plugins;
    bool embed = false, lenient = false;
};

struct PlotOptions {
    std::string source;               ///< a directory of results, a recording, or a system
    std::vector<std::string> plots;  ///< what to draw
    std::string directory;            ///< empty: beside the source, or here for a system
    std::string plot_format = "png";
};

struct ExperimentOptions {
    std::string file;
    std::string directory;  ///< empty: forage-out/ and the file's name
    std::vector<std::string> plugins = {};
    int jobs = 0;        ///< runs at a time; 0: one per core
    bool fresh = false;  ///< repeat finished runs
    bool quiet = false;
};

struct WorldCommand {
    std::string file;     ///< .world
    std::string picture;  ///< .png, .svg or .pdf; empty: the world's name with .png, here
    bool game = false;
};

struct TutorialOptions {
    std::string exercise;   ///< its number; empty: list them
    std::string directory;  ///< empty: forage-out/tutorial/ and the number
};

struct BuildPluginOptions {
    std::string source;
    std::string output;  ///< empty: in the folder plugins beside the source
};

int run(const RunOptions& options);
/// Brings a run to its end with progress and a summary. Returns the exit status.
int run_to_end(const RunOptions& options, PreparedRun& prepared);
/// Goes on with a run that was stopped, from its last checkpoint: what it leaves behind is then what it would
/// have left without a stop.
int resume(const ResumeOptions& options, const RunParser& parse);
int plot(const PlotOptions& options);
/// Runs every combination of an experiment file with every seed; what was finished before is not repeated.
int experiment(const ExperimentOptions& options);
/// Lists the exercises of the tutorial, or runs one.
int tutorial(const TutorialOptions& options);
int convert(const ConvertOptions& options);
int check(const RunInput& input);
/// Checks a world, lists what is in it and draws it from above.
int world(const WorldCommand& options);
/// Prints the tree of processes, groups and connections, with sizes and how each connection is computed.
int describe(const RunInput& input);
/// Writes a page that shows the pictures and tables of a directory of results: plain HTML, nothing from the
/// net.
int view(const std::string& directory);
/// Lists the types, or one with its parameters.
int types(const std::string& name, const std::vector<std::string>& plugins);
/// Prints a RELAX NG schema of system files with these types.
int schema(const std::vector<std::string>& plugins);

/// Writes a project with a plugin into the folder `name`; `kind` is neuron, synapse or module.
int new_project(const std::string& kind, const std::string& name);
/// Compiles a source file to a plugin, with the compiler that CXX names or c++, and tries whether it loads.
int build_plugin(const BuildPluginOptions& options);

}  // namespace forage::tool
