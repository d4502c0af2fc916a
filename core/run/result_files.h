// The files that a run leaves behind in its directory.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace forage {

/// Collects the files that observers write at the end of a run. A file that cannot be written does not keep the others from
/// being written.
class ResultFiles {
  public:
    /// `directory`: where the files go; it must exist. Without one (empty), nothing is written.
    explicit ResultFiles(std::string directory) : directory_(std::move(directory)) {}

    const std::string& directory() const { return directory_; }
    std::string path(const std::string& name) const { return directory_ + "/" + name; }

    /// Writes content() to the file `name`; a failure becomes a problem.
    void write(const std::string& name, const std::function<std::string()>& content);
    /// Calls action(), which makes the files `names` itself; a failure becomes a problem, and the files are not listed.
    void attempt(const std::function<void()>& action, const std::vector<std::string>& names = {});

    /// What a recording file holds, for run.json.
    struct Recording {
        std::string file, source, label;
    };
    void add_recording(Recording recording) { recordings_.push_back(std::move(recording)); }

    /// Adds a line to the summary of the run, such as "film" and "a.gif: 30 frames".
    void note(std::string name, std::string text) { notes_.emplace_back(std::move(name), std::move(text)); }

    const std::vector<std::pair<std::string, std::string>>& notes() const { return notes_; }
    const std::vector<std::string>& names() const { return names_; }
    const std::vector<Recording>& recordings() const { return recordings_; }
    const std::vector<std::string>& problems() const { return problems_; }

  private:
    std::string directory_;
    std::vector<std::string> names_, problems_;
    std::vector<std::pair<std::string, std::string>> notes_;
    std::vector<Recording> recordings_;
};

}  // namespace forage
