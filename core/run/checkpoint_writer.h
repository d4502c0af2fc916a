// Checkpoints: everything that a run needs to continue as if it had never stopped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/run/input_files.h"

namespace forage {

/// How a run was started; the first part of a checkpoint.
struct CheckpointOrigin {
    std::string version;                 ///< version of Forage
    std::vector<std::string> arguments;  ///< arguments of `forage run`
    std::string working_directory;       ///< relative paths start here
    InputFiles files;                    ///< digests when the run began
    InputFiles module_files;             ///< digests in this cycle, as modules may write their files
    std::uint64_t cycle = 0;

    void checkpoint(Archive& archive) {
        archive(version, arguments, working_directory, files, module_files, cycle);
    }
};

/// Writes checkpoints of a run into its directory. Must be the last observer of the run.
class CheckpointWriter final : public Observer {
  public:
    /// Writes a checkpoint every `every` cycles, and when one of `module_files` has changed, because a run
    /// cannot be resumed from an older checkpoint with the changed file. `directory` is that of the results.
    CheckpointWriter(std::string directory, std::uint64_t every, CheckpointOrigin origin,
                     const std::vector<std::string>& module_files);

    /// Throws std::runtime_error when a checkpoint cannot be written.
    void after_cycle(RunView& run) override;
    /// Writes a checkpoint now.
    void write(Run& run);

  private:
    bool module_file_changed();

    struct ModuleFile {
        std::string path;
        std::filesystem::file_time_type time{};
    };
    std::string directory_;
    std::uint64_t every_;
    CheckpointOrigin origin_;
    std::vector<ModuleFile> module_files_;
};

/// Reports modules that do not declare what they keep: their state can be neither written nor digested.
/// `option` needs this state, such as "--hash".
void check_checkpoints(const engine::Layout& layout, const std::string& option, Diagnostics& diagnostics);

}  // namespace forage
