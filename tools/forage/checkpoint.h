// What is in a checkpoint: all that a run needs to go on as if it had never stopped.
#pragma once

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
    InputFiles files;
    std::uint64_t cycle = 0;

    void checkpoint(Archive& archive) { archive(version, arguments, working_directory, files, cycle); }
};

/// Writes checkpoints of a run into its directory, in the cycles in which they are due.
class Checkpoints {
  public:
    /// Reads the files that the run depends on, for their digests.
    Checkpoints(const RunOptions& options, const Sources& sources, const Running& running);

    /// After a cycle. Throws std::runtime_error.
    void follow(Running& running) {
        if (every_ > 0 && running.simulation.cycle() % every_ == 0) write(running);
    }
    /// When a run is stopped in order. Has no effect when no checkpoints are wanted.
    void stop(Running& running) {
        if (every_ > 0) write(running);
    }

  private:
    void write(Running& running);

    std::uint64_t every_ = 0;  ///< cycles; 0: none are wanted
    std::string directory_;
    CheckpointOrigin origin_;
};

/// Reports what keeps this run from being checkpointed, or its state from being digested, if that is wanted.
void check_checkpoints(const RunOptions& options, const Loaded& loaded, const engine::Simulation& simulation,
                       Diagnostics& diagnostics);

/// A digest of all that decides the cycles to come, in system and world: two runs that were the same have the
/// same one. Throws RunError for modules that do not declare what they keep.
std::string state_digest(Running& running);

}  // namespace forage::tool
