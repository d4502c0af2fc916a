#include "tools/cluster/slurm.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/shell_word.h"

namespace forage::cluster {
namespace {

namespace fs = std::filesystem;

/// Reports names and options that would not stay within their line of a script, or that sbatch would read
/// in another way.
void check_names(const SlurmJob& job, const std::string& logs, Diagnostics& diagnostics) {
    const auto refuse = [&](const std::string& what, const std::string& name, const char* why,
                            const char* hint) {
        diagnostics.error({}, fmt::format("{} '{}' {}, which cannot be in a script", what, name, why), hint);
    };
    const auto check = [&](const std::string& what, const std::string& name, const char* hint) {
        if (has_control(name)) refuse(what, name, "has a line end or another control character", hint);
    };
    check("the name of the experiment", job.file, "rename the file");
    check("the folder", fs::current_path().string(), "submit from another folder");
    check("the folder of the results", job.directory, "choose another directory with -o");
    check("the program", fs::read_symlink("/proc/self/exe").string(), "install Forage in another folder");
    for (const auto& p : job.plugins) check("the plugin", p, "rename it");
    for (const auto& option : job.sbatch) check("the option of sbatch", option, "give one option at a time");
    if (logs.find_first_of("\"\\") != std::string::npos)
        refuse("the folder of the results", logs, "has a quotation mark or a backslash",
               "choose another directory with -o");
}

/// A path in a pattern of file names of sbatch.
std::string in_pattern(const std::string& path) {
    std::string out;
    for (const char c : path) out += c == '%' ? std::string("%%") : std::string(1, c);
    return out;
}

constexpr const char* parts_script = R"(#!/bin/sh
# Executes one part of an experiment per task. `forage experiment --slurm` has written and submitted this file.
# You may change it and submit it yourself:
#   parts=$(sbatch --parsable {parts}) && sbatch --dependency=afterany:$parts {merge}{round}
#SBATCH --job-name={name}
#SBATCH --array=1-{tasks}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="{logs}/part-%a.log"
{options}
cd {here} || exit 1
{command} --shard "$SLURM_ARRAY_TASK_ID/{tasks}" --jobs "${{SLURM_CPUS_PER_TASK:-1}}" --quiet
status=$?
# A part that was killed starts again with the runs that have no result yet, at most five times. When a node
# fails, Slurm itself starts the part again.
if [ $status -ge 128 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt 5 ]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit $status
)";

constexpr const char* merge_script = R"(#!/bin/sh
# Writes the tables of an experiment when all parts have ended. Its argument is the number of the round, if the experiment
# adapts itself: when another round follows, both scripts are submitted again.
#SBATCH --job-name={name}-merge
#SBATCH --requeue
#SBATCH --output="{logs}/merge.log"
{options}
cd {here} || exit 1
{command} --merge ${{1:+--after-round "$1"}}
)";

struct Said {
    std::string text;  ///< what the command printed
    int status = 0;
};

Said run(const std::string& command) {
    Said out;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return {"it cannot be started", 127};
    std::array<char, 256> buffer;
    while (fgets(buffer.data(), buffer.size(), pipe)) out.text += buffer.data();
    out.status = pclose(pipe);
    while (!out.text.empty() && out.text.back() == '\n') out.text.pop_back();
    return out;
}

/// The number of a job that sbatch has submitted; empty after an error, which it reports.
std::string sbatch(const std::string& arguments, Diagnostics& diagnostics) {
    const Said said = run("sbatch --parsable " + arguments);
    if (said.status == 0) return said.text.substr(0, said.text.find(';'));  // "ID;CLUSTER"
    diagnostics.error({}, fmt::format("sbatch failed: {}", said.text),
                      "submit from a machine with Slurm; --dry-run only writes the scripts");
    return {};
}

/// Submits both scripts. Returns a line about `what`, which it adds to the list of jobs.
std::string submit_scripts(const std::string& logs, const std::string& what, const std::string& round,
                           Diagnostics& diagnostics) {
    const std::string array = sbatch(shell_word(logs + "/parts.sh"), diagnostics);
    if (array.empty()) return {};
    const std::string last =
        sbatch(fmt::format("--dependency=afterany:{} {}{}", array, shell_word(logs + "/merge.sh"), round),
               diagnostics);
    const std::string line = fmt::format("Slurm jobs {} ({}) and {} (merge)", array, what, last);
    std::ofstream(logs + "/jobs", std::ios::app) << line << '\n';
    return line + "\n";
}

std::string logs_of(const std::string& directory) {
    return fs::absolute(directory + "/slurm").lexically_normal().string();
}

/// The argument of merge.sh.
std::string argument_of(std::size_t round) { return round > 0 ? fmt::format(" {}", round) : ""; }

}  // namespace

std::string submit(const SlurmJob& job, std::size_t runs, bool dry_run, Diagnostics& diagnostics) {
    const std::size_t tasks = std::min<std::size_t>(job.tasks > 0 ? job.tasks : 100, runs);
    const std::string logs = logs_of(job.directory), round = argument_of(job.round);
    const std::string parts = logs + "/parts.sh", merge = logs + "/merge.sh";
    check_names(job, logs, diagnostics);
    if (diagnostics.failed()) return {};
    std::string command =
        fmt::format("{} experiment {} -o {}", shell_word(fs::read_symlink("/proc/self/exe").string()),
                    shell_word(job.file), shell_word(job.directory));
    for (const auto& p : job.plugins) command += " --plugin " + shell_word(p);
    std::string options;
    for (const auto& option : job.sbatch) options += "#SBATCH " + option + "\n";
    const auto written = [&](const std::string& path, const char* text) {
        write_file(
            path,
            fmt::format(fmt::runtime(text), fmt::arg("parts", shell_word(parts)),
                        fmt::arg("merge", shell_word(merge)),
                        fmt::arg("name", file_name("forage-" + fs::path(job.file).stem().string())),
                        fmt::arg("tasks", tasks), fmt::arg("logs", in_pattern(logs)),
                        fmt::arg("options", options), fmt::arg("command", command), fmt::arg("round", round),
                        fmt::arg("here", shell_word(fs::current_path().string()))));
    };
    try {
        make_directory(logs);
        written(parts, parts_script);
        written(merge, merge_script);
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what(), "choose another directory for the results with -o");
        return {};
    }
    if (dry_run)
        return fmt::format(
            "written: {0}, {1}\nparts=$(sbatch --parsable {2}) && sbatch --dependency=afterany:$parts "
            "{3}{4}\n",
            parts, merge, shell_word(parts), shell_word(merge), round);
    return submit_scripts(logs, fmt::format("{} parts", tasks), round, diagnostics);
}

std::string submit_round(const std::string& directory, std::size_t round, Diagnostics& diagnostics) {
    return submit_scripts(logs_of(directory), fmt::format("round {}", round), argument_of(round),
                          diagnostics);
}

std::vector<std::string> submitted_jobs(const std::string& directory) {
    std::vector<std::string> out;
    std::ifstream in(directory + "/slurm/jobs");
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

}  // namespace forage::cluster
