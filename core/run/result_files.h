// The files that a run leaves behind in its directory.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/types/cell_names.h"

namespace forage {

/// Collects the files that observers write at the end of a run. When one file cannot be written, the others
/// still are.
class ResultFiles {
  public:
    /// `directory` must exist. When it is empty, nothing is written. The text of the file `kept` is kept in
    /// memory, too.
    explicit ResultFiles(std::string directory, std::string kept = {})
        : directory_(std::move(directory)), kept_name_(std::move(kept)) {}

    const std::string& directory() const { return directory_; }
    std::string path(const std::string& name) const { return directory_ + "/" + name; }

    /// The text of the file that is kept; empty when there is none.
    const std::string& kept() const { return kept_; }

    /// Writes content() to the file `name`. A failure is added to problems().
    void write(const std::string& name, const std::function<std::string()>& content);
    /// Calls action(), which writes files and adds each of them. A failure is added to problems().
    void attempt(const std::function<void()>& action);
    /// Adds a file that was written to names().
    void add(std::string name) { names_.push_back(std::move(name)); }

    /// A recording file and its content, for run.json.
    struct Recording {
        std::string file, source, label;
        CellNames names = {};
    };
    void add_recording(Recording recording) { recordings_.push_back(std::move(recording)); }

    /// Adds a line to the summary of the run, such as "film" and "a.gif: 30 frames".
    void note(std::string name, std::string text) { notes_.emplace_back(std::move(name), std::move(text)); }

    /// Adds a warning for the user.
    void warn(std::string text, std::string hint) { warnings_.warning({}, std::move(text), std::move(hint)); }
    const Diagnostics& warnings() const { return warnings_; }

    const std::vector<std::pair<std::string, std::string>>& notes() const { return notes_; }
    /// The names of the written files, in alphabetical order.
    std::vector<std::string> names() const {
        auto out = names_;
        std::sort(out.begin(), out.end());
        return out;
    }
    const std::vector<Recording>& recordings() const { return recordings_; }
    const std::vector<std::string>& problems() const { return problems_; }

  private:
    std::string directory_, kept_name_, kept_;
    std::vector<std::string> names_, problems_;
    std::vector<std::pair<std::string, std::string>> notes_;
    std::vector<Recording> recordings_;
    Diagnostics warnings_;
};

}  // namespace forage
