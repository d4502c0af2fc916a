// The commands of the program. Each takes its options and returns the exit status: 0 fine, 1 the run failed,
// 2 bad usage or bad input.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/forage/load.h"

namespace forage::tool {

enum ExitStatus { fine = 0, run_failed = 1, bad_input = 2 };

struct RunOptions {
    Input input;
    std::optional<std::uint64_t> cycles;
    std::optional<double> seconds;
    std::optional<std::uint64_t> trials;
    double longest_trial = 300;  ///< s of the world
    model::Wish until;           ///< a condition that ends the run before its time; none when empty
    std::vector<model::RecordingWish> recordings;
    std::vector<model::TimedWish> at;
    std::vector<model::Measure> measures;
    std::vector<std::string> clamp;  ///< tables
    std::vector<model::ManipulationWish> manipulations;
    int threads = 1;
    std::string directory = "forage-out";
    bool paths = true;  ///< follow the robots
    bool real_time = false, quiet = false;
};

struct ConvertOptions {
    std::string input, output;         ///< .iqr or .iqrProcess, both
    std::vector<std::string> imports;  ///< process files to add
    std::string extract;               ///< name or id of a process to write on its own
    bool embed = false, lenient = false;
};

struct ExperimentOptions {
    std::string file;
    std::string directory;  ///< empty: forage-out/ and the file's name
    int jobs = 0;           ///< runs at a time; 0: one per core
    bool fresh = false;     ///< repeat finished runs
    bool quiet = false;
};

int run(const RunOptions& options);
/// Runs every combination of an experiment file with every seed; what was finished before is not repeated.
int experiment(const ExperimentOptions& options);
int convert(const ConvertOptions& options);
int check(const Input& input);
/// Lists the types, or one with its parameters.
int types(const std::string& name);
/// Prints a RELAX NG schema of system files with the types that ship.
int schema();

}  // namespace forage::tool
