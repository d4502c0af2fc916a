// The recordings of a run: files that grow under another name and get their own when the run ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/observe/recorder.h"
#include "core/run/result_files.h"
#include "core/run/run_spec.h"

namespace forage {

/// A file that a run records, and what it holds.
struct RecordingFile {
    std::string name;  ///< within the directory
    observe::RecordingFormat format;
    std::vector<observe::Source> sources;
    std::uint64_t every = 1;  ///< cycles from row to row
    std::string archive;      ///< the .npz file that it becomes a part of; empty for others
};

/// The files for what a user wants recorded. Reports what is not there or cannot be put together.
std::vector<RecordingFile> recorded_files(const std::vector<model::RecordingSpec>& recordings,
                                          const RecordOptions& options, const engine::Layout& layout,
                                          Diagnostics& diagnostics);

/// Records sources into files while the run lasts.
class Recordings final : public Observer {
  public:
    /// `attributes` is what a file may say of the run.
    Recordings(std::vector<RecordingFile> files, const RecordOptions& options, const std::string& directory,
               const std::vector<std::pair<std::string, std::string>>& attributes);

    void declare(engine::Demand& demand) const override {
        for (const auto& f : all_)
            for (const auto& s : f.file.sources) s.declare(demand);
    }
    /// Begins the files. Throws std::runtime_error when one cannot be opened; none is left then.
    void begin_files(ResultFiles&) override;
    /// Writing: brings all rows to the disk and notes where the files are. Reading: goes on where they were,
    /// instead of begin(), also in files that had got their names. Throws std::runtime_error.
    void checkpoint(Archive& archive) override;

    void after_cycle(RunView& run) override {
        for (auto& f : all_) f.recorder->record(run.simulation);
    }
    /// Closes every file and gives it its name, also when one of them fails.
    void finish(RunView&, ResultFiles& files) override;

    std::vector<std::string> file_names() const override;


  private:
    struct File {
        RecordingFile file;
        std::string path;
        observe::RowFileHeader header;
        std::optional<observe::Recorder> recorder;  ///< once it is open
    };
    void open(File& file, const std::optional<observe::RowFilePosition>& go_on);
    void reopen(const File& file) const;

    std::vector<File> all_;
    RecordOptions options_;
    std::string directory_;
    std::vector<ResultFiles::Recording> entries_;
};

}  // namespace forage
