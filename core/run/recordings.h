// The recordings of a run: files that grow as NAME.part and are renamed to NAME when the run ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/observe/recorder.h"
#include "core/run/result_files.h"
#include "core/run/run_spec.h"

namespace forage {

/// A file that a run records, and its sources.
struct RecordingFile {
    std::string name;  ///< relative to the directory of results
    observe::RecordingFormat format;
    std::vector<observe::Source> sources;
    std::uint64_t every = 1;  ///< cycles between two rows
    std::string archive;      ///< the .npz file of which it becomes a part; empty for other formats
};

/// The files for the recordings that a user asks for. Reports unknown sources, and sources that cannot share
/// a file.
std::vector<RecordingFile> recorded_files(const std::vector<model::RecordingSpec>& recordings,
                                          const RecordOptions& options, const engine::Layout& layout,
                                          Diagnostics& diagnostics);

/// Records sources into files while the run lasts.
class Recordings final : public Observer {
  public:
    /// `attributes` are facts about the run, for formats that can store them.
    Recordings(std::vector<RecordingFile> files, const RecordOptions& options, const std::string& directory,
               const std::vector<std::pair<std::string, std::string>>& attributes);

    void declare(engine::Demand& demand) const override {
        for (const auto& f : all_)
            for (const auto& s : f.file.sources) s.declare(demand);
    }
    /// Opens the files. When one cannot be opened, removes the others and throws std::runtime_error.
    void begin_files(ResultFiles&) override;
    /// When it writes a checkpoint, flushes all rows to the disk and stores the positions in the files. When
    /// it reads one, continues at these positions, which replaces begin_files(), also in files that have been
    /// renamed. Throws std::runtime_error.
    void checkpoint(Archive& archive) override;

    /// Leaves out the cycles from now on, until it is called with false. A mean of several cycles then
    /// starts again.
    void pause(bool paused) { paused_ = paused; }

    void after_cycle(RunView& run) override {
        if (paused_) return;
        for (auto& f : all_) f.recorder->record(run.simulation);
    }
    /// Closes and renames every file, also when one of them fails.
    void finish(RunView&, ResultFiles& files) override;

    std::vector<std::string> file_names() const override;

  private:
    struct File {
        RecordingFile file;
        std::string path;
        observe::RowFileHeader header;
        std::optional<observe::Recorder> recorder;  ///< empty until the file is open
    };
    void open(File& file, const std::optional<observe::RowFilePosition>& go_on);
    void reopen(const File& file) const;

    std::vector<File> all_;
    RecordOptions options_;
    std::string directory_;
    bool paused_ = false;
    std::vector<ResultFiles::Recording> entries_;
};

}  // namespace forage
