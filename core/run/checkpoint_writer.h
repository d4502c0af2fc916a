// Checkpoints: all that a run needs to go on as if it had never stopped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/run/input_files.h"

namespace forage {

/// What a run was started with; the first part of a checkpoint.
struct CheckpointOrigin {
    std::string version;                 ///< of Forage
    std::vector<std::string> arguments;  ///< of `forage run`
    std::string working_directory;       ///< relative file names start here
    InputFiles files;                    ///< when the run began
    InputFiles module_files;             ///< in this cycle: modules may write theirs
    std::uint64_t cycle = 0;

    void checkpoint(Archive& archive) {
        archive(version, arguments, working_directory, files, module_files, cycle);
    }
};

/// Writes checkpoints of a run into its directory. Must be the last observer of the run.
class CheckpointWriter final : public Observer {
  public:
    /// Writes every `every` cycles, and when one of `module_files` has changed: before that cycle the run could not go on with
    /// the file as it is now. `directory`: of the results.
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

/// Reports modules that do not declare what they keep, so that their state can neither be written nor digested. `option`: what
/// needs it, such as "--hash".
void check_checkpoints(const engine::Layout& layout, const std::string& option, Diagnostics& diagnostics);

}  // namespace forage
