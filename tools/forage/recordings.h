// The recordings of a run: files that grow under another name and get their own when the run ends.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/observe/recorder.h"

namespace forage::tool {

/// The columns that a person wants, by the file name that each one gets. Reports those that are not there.
std::map<std::string, observe::ColumnRef> recorded_columns(const std::vector<model::Wish>& wishes,
                                                           const engine::Simulation& simulation,
                                                           Diagnostics& diagnostics);

class Recordings {
  public:
    /// Throws std::runtime_error when a file cannot be opened; none is left then.
    Recordings(std::map<std::string, observe::ColumnRef> columns, std::uint64_t every,
               const std::string& directory, const engine::Simulation& simulation);

    /// After each cycle. Throws std::runtime_error when a file cannot be written.
    void record(const engine::Simulation& simulation) {
        for (auto& r : all_) r.recorder.record(simulation);
    }
    /// Closes every file and gives it its name, also when one of them fails. Returns what went wrong; empty
    /// when nothing did.
    std::string finish();

    std::vector<std::string> files() const;  ///< their names within the directory

  private:
    struct Recording {
        std::string name, path;
        observe::Recorder recorder;
    };
    std::vector<Recording> all_;
};

}  // namespace forage::tool
