// The commands of the program. Each of them takes its options and returns the exit status: 0 for success, 1
// when the run failed, 2 for wrong usage or wrong input.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/api/open/prepare.h"

namespace forage::tool {

enum ExitStatus { fine = 0, run_failed = 1, bad_input = 2 };

struct RunOptions {
    RunOptions() { spec.directory = "forage-out"; }
    RunSpec spec;
    bool real_time = false;  ///< whether the run is slowed down to the clock
    bool quiet = false;
};

struct ResumeOptions {
    std::string path;  ///< a directory of results, or a checkpoint in it
    int threads = 0;   ///< 0 for as many as before the stop
    bool quiet = false;
};
struct RerunOptions {
    std::string path;                        ///< a bundle, a run.json or a directory of results
    std::string directory = "forage-rerun";  ///< where it is unpacked and run
    bool quiet = false;
};
/// Parses the arguments of `forage run`.
using RunParser = std::function<RunOptions(const std::vector<std::string>& arguments)>;

struct ConvertOptions {
    std::string input, output;         ///< .iqr or .iqrProcess files
    std::vector<std::string> imports;  ///< process files to add
    /// Name or id of the process to write as a file of its own; empty: the whole system.
    std::string extract;
    std::string as_plugin;  ///< name of a declared type to write as the source of a plugin; empty: none
    std::vector<std::string> plugins;
    bool terse = false, full = false;
    bool original = false;  ///< whether to write everything that the original requires
    bool embed = false, lenient = false;
};

struct EditOptions {
    std::string file;        ///< .iqr or .world
    std::string operations;  ///< JSON, or the name of a file with it
    std::string output;      ///< empty: the file itself
    std::vector<std::string> plugins;
};

struct PlotOptions {
    std::string source;              ///< a directory of results, a recording, or a system
    std::vector<std::string> plots;  ///< the pictures to draw
    std::vector<std::string> where;  ///< which runs of an experiment to draw: "PARAMETER=VALUE"
    std::string directory;           ///< empty: beside the source; for a system, the working directory
    std::string plot_format = "png";
    std::string layout;  ///< "ROWSxCOLUMNS" of the panels of one figure; empty: a file per plot
    std::string width;   ///< "85mm" or "600px"; empty: that of each picture
};

struct DescribeOptions {
    RunInput input;
    std::string format = "text";  ///< text, markdown, latex, dot or json
};

struct ExperimentOptions {
    std::string file;
    std::string directory;  ///< empty: forage-out/ and the file's name
    std::string system;     ///< a system to check against the file's exercise; empty: run the file's system
    std::vector<std::string> plugins = {};
    int jobs = 0;        ///< number of simultaneous runs; 0: one per core
    bool fresh = false;  ///< whether finished runs are repeated
    bool quiet = false;
    std::vector<std::string> formats = {};  ///< of further tables: "npy", "hdf5"
    std::string bundle = {};                ///< archive for everything that repeats it; none when empty
    std::string shard = {};                 ///< "3/10": executes this part only
    bool merge = false, status = false;
    std::size_t after_round = 0;  ///< with merge: Slurm gets the next round when a later one is planned
    bool slurm = false, dry_run = false;   ///< submits to Slurm, or only writes the scripts
    int tasks = 0;                         ///< of Slurm's array; 0: at most 100
    std::vector<std::string> sbatch = {};  ///< further options of sbatch, such as "--partition=short"
};

/// The words of the command line that decide the results of an experiment.
std::vector<std::string> command_of(const ExperimentOptions& options);

struct WorldCommand {
    std::string file;     ///< .world
    std::string picture;  ///< .png, .svg or .pdf; empty: the name of the world or robot with .png
    bool game = false;
    std::string robot;  ///< prints and draws the data sheet of this robot instead of the world
};

struct TutorialOptions {
    std::string exercise;   ///< number of the exercise, or an experiment file; empty: list all exercises
    std::string directory;  ///< empty: forage-out/tutorial/ and the number
    std::string system;     ///< a system of the user's own; empty: run the exercise's system
};

struct NewOptions {
    std::string kind;    ///< system, neuron, synapse or module
    std::string name;    ///< empty: my_system
    bool robot = false;  ///< whether the system has a robot, and a world for it
};

struct SchemaOptions {
    bool of_experiments = false;  ///< the schema of experiment files instead of system files
    bool markdown = false;        ///< tables for the reference instead of a schema
    std::vector<std::string> plugins = {};
};

struct StudioCommand {
    RunInput input;
    std::string plot_config;  ///< a layout to open; may be empty
    int port = 0;             ///< 0: a free one
    bool recover = false;     ///< whether to resume the session that was killed
    bool running = false;     ///< whether the run begins at once
    bool open = false;        ///< whether a browser is opened
};

struct BuildPluginOptions {
    std::string source;
    std::string output;  ///< empty: the folder plugins beside the source
    bool debug = false;
};

struct TrustOptions {
    std::string folder;  ///< empty: list the trusted ones
    bool remove = false;
};

int run(const RunOptions& options);
/// Runs to the end, with a progress line and a summary. Returns the exit status.
int run_to_end(const RunOptions& options, PreparedRun& prepared);
/// Continues a stopped run from its last checkpoint. It writes the same files as an uninterrupted run.
int resume(const ResumeOptions& options, const RunParser& parse);
/// Repeats a run or an experiment, and compares the results with those of before.
int rerun(const RerunOptions& options, const RunParser& parse);
int plot(const PlotOptions& options);
/// Runs every combination of an experiment file with every seed. Runs that were finished before are not
/// repeated.
int experiment(const ExperimentOptions& options);
/// Lists the exercises of the tutorial, or runs one.
int tutorial(const TutorialOptions& options);
int convert(const ConvertOptions& options);
/// Carries out operations of the studio in a file, and prints the ids that they make.
int edit(const EditOptions& options);
int check(const RunInput& input);
/// Checks a world, lists its contents and draws it from above.
int world(const WorldCommand& options);
/// Prints the processes, groups and connections of a system, with sizes.
int describe(const DescribeOptions& options);
/// Writes a page with the pictures and tables of a directory of results: plain HTML that loads nothing from
/// the network.
int view(const std::string& directory);
/// Becomes the program forage-studio, which runs a system that browsers on this machine watch and touch,
/// until Ctrl-C. `arguments` are those of `forage`, with a null pointer at the end.
int studio(char** arguments);
/// Lists the types, or describes one with its parameters.
int types(const std::string& name, const std::vector<std::string>& plugins);
/// Prints a RELAX NG schema, or the tables of the reference.
int schema(const SchemaOptions& options);

/// Writes the beginning of a system, or the project of a plugin into the folder `name`.
int create(const NewOptions& options);
/// Compiles a source file to a plugin, with the compiler in CXX or else c++, and checks that it can be
/// loaded.
int build_plugin(const BuildPluginOptions& options);
/// Lists the folders whose plugins are trusted, or changes the list.
int trust(const TrustOptions& options);
/// On a terminal, asks whether the plugins of a run in folders that are not trusted may be loaded.
void ask_for_trust(const RunInput& input);

}  // namespace forage::tool
