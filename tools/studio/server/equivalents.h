// What does the same as an action in a page: options of `forage run` or another command, and Python.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/run/run_spec.h"

namespace forage::studio {

/// Both may be empty. A line of `shell` is options of `forage run`, or another command.
struct Equivalent {
    std::string shell, python;
};
/// One after the other.
Equivalent operator+(const Equivalent& first, const Equivalent& second);

/// A change of parameters before the cycle with this number.
Equivalent of_assignments(const std::vector<std::string>& assignments, std::uint64_t cycle);
/// A manipulation of a group with one pattern or several, each a number per cell in rows of `width`, before
/// the cycle with this number.
struct DrivenGroup {
    std::string group, mode;
    std::vector<std::vector<double>> patterns;
    int width = 1;
    std::uint64_t every = 1, step = 1;
    std::optional<std::uint64_t> times = {};
    bool backwards = false;
};
/// Its begin, and its end when it began before the cycle `from`.
Equivalent of_manipulation(const DrivenGroup& driven, std::uint64_t cycle);
Equivalent of_end(const DrivenGroup& driven, std::uint64_t from, std::uint64_t cycle);
/// A file that is edited, as `forage edit` names it; the path is empty for none.
struct EditedFile {
    std::string path;
    std::vector<std::string> plugins = {};
};
/// Operations on the system in a file, and on a System of Python. Empty when they are longer than 100,000
/// bytes; the shell's also without a file.
Equivalent of_edit(const EditedFile& file, const nlohmann::json& operations);
/// A system that is saved in the file `to`. The shell's is empty for the same file, which `forage edit` has
/// written.
Equivalent of_save(const EditedFile& file, const std::string& to);
/// Operations on the world in a file; empty as those of a system are.
Equivalent of_world_edit(const EditedFile& file, const nlohmann::json& operations);
/// A world that is saved under another name, after these operations.
Equivalent of_world_copy(const EditedFile& file, const nlohmann::json& operations, const std::string& to);
/// A robot or an object that is moved before the cycle with this number.
Equivalent of_move(const std::string& name, double x, double y, double heading, std::uint64_t cycle);
/// A new trial before the cycle with this number; `start` is -1 for the next start pose.
Equivalent of_trial(const std::string& robot, int start, std::uint64_t cycle);
/// The system and the world of a run that restarts; `edited` when the file of the system is not what runs.
struct Opened {
    std::string system, world;
    std::uint64_t seed;
    bool edited = false;
};
/// It begins with another seed, or in another world; the world is empty for none.
Equivalent of_restart(const Opened& opened);
Equivalent of_world(const Opened& opened);
/// A run until so many trials have ended or a condition holds; it is empty for none. On the command line,
/// trials and seconds count from the start of the run.
Equivalent of_run(const RunLength& length, const RunLength& from_start);
/// A recording into a file, of every n-th cycle from the first to the last one.
struct Sampled {
    std::vector<std::string> sources;
    std::string file;
    std::uint64_t every = 1, from = 0;
    std::optional<std::uint64_t> until = {};
};
/// Its begin, and its end, which has no `until` when no row was recorded.
Equivalent of_sampling(const Sampled& sampled);
Equivalent of_sampling_end(const Sampled& sampled);

}  // namespace forage::studio
