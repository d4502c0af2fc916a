// The files that modules write: they grow as NAME.part, as recordings do, and are renamed when the run ends.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/observe/row_file.h"

namespace forage {

/// Writes to the disk, at least once a second, what modules have written into the streams that they opened at
/// start (ModulePorts::open).
class ModuleFiles final : public Observer {
  public:
    /// `directory` is that of the results; with none, what modules write is forgotten.
    explicit ModuleFiles(std::string directory) : directory_(std::move(directory)) {}

    /// Lets modules open files from now until the first cycle, under other names than those of `observers`.
    void begin(const std::vector<std::unique_ptr<Observer>>& observers);
    /// Opens the file `process`_`name`, which appears in the directory after the first cycle. Throws
    /// std::runtime_error when it is the file of another module or observer, and std::logic_error when
    /// modules cannot open files now.
    std::ostream& open(const std::string& process, const std::string& name);

    void before_cycle(RunView&) override { opening_ = false; }
    void after_cycle(RunView&) override;
    std::vector<std::string> file_names() const override;
    /// Writes and renames every file, also when one of them fails.
    void finish(RunView&, ResultFiles& files) override;
    /// When it writes a checkpoint, writes everything to the disk and stores the lengths of the files. When
    /// it reads one, forgets what start() has written again; the next cycle cuts the files to these lengths.
    /// Throws std::runtime_error, and ShortFile when a file is shorter.
    void checkpoint(Archive& archive) override;

  private:
    struct File {
        std::string name, path;
        std::ostringstream text;  ///< not on the disk yet
        std::optional<observe::BlockFile> file;
        std::optional<std::uint64_t> kept;  ///< length at the checkpoint from which the run continues, bytes
    };
    void write(File& file) const;

    std::string directory_;
    std::vector<std::unique_ptr<File>> files_;  ///< modules refer to the streams
    std::set<std::string> taken_;               ///< names of other files
    bool opening_ = false;
    std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace forage
