// What is in a checkpoint: all that a run needs to go on as if it had never stopped.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/forage/input_files.h"
#include "tools/forage/running.h"

namespace forage::tool {

/// Where a checkpoint comes from: what the run was started with.
struct CheckpointOrigin {
    std::string version;                 ///< of forage
    std::vector<std::string> arguments;  ///< of `forage run`
    std::string working_directory;       ///< in which they name files
    InputFiles files;                    ///< when the run began
    InputFiles module_files;             ///< in this cycle: modules may write theirs
    std::uint64_t cycle = 0;

    void checkpoint(Archive& archive) {
        archive(version, arguments, working_directory, files, module_files, cycle);
    }
};

/// Writes checkpoints of a run into its directory, in the cycles in which they are due.
class Checkpoints {
  public:
    /// Reads the files that the run depends on, for their digests.
    Checkpoints(const RunOptions& options, const Sources& sources, const Running& running);

    /// After a cycle. A checkpoint also follows when a module has written its file: before that cycle the run
    /// could not go on with the file as it is now. Throws std::runtime_error.
    void follow(Running& running) {
        if (every_ > 0 && (running.simulation.cycle() % every_ == 0 || written())) write(running);
    }
    /// When a run is stopped in order. Has no effect when no checkpoints are wanted.
    void stop(Running& running) {
        if (every_ > 0) write(running);
    }

  private:
    void write(Running& running);
    /// Whether a file of a module has changed since the last call.
    bool written();

    struct ModuleFile {
        std::string path;
        std::filesystem::file_time_type time{};
    };
    std::vector<ModuleFile> module_files_;
    std::uint64_t every_ = 0;  ///< cycles; 0: none are wanted
    std::string directory_;
    CheckpointOrigin origin_;
};

/// Reports what keeps this run from being checkpointed, or its state from being digested, if that is wanted.
void check_checkpoints(const RunOptions& options, const engine::Layout& layout, Diagnostics& diagnostics);

/// A digest of all that decides the cycles to come, in system and world: two runs that were the same have the
/// same one. Throws RunError for modules that do not declare what they keep.
std::string state_digest(Running& running);

}  // namespace forage::tool
