// What a program that is killed leaves of its session: a file that is written while the session lives.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/archive.h"
#include "core/base/output_files.h"
#include "core/run/run_spec.h"
#include "tools/api/open/sources.h"

namespace forage::studio {

/// The user's folder of states: $XDG_STATE_HOME, or ~/.local/state. Throws std::runtime_error without a home.
std::string state_home();

/// Creates a folder of Forage in the user's folder of states, which only the user can read, and returns its
/// path. Throws std::runtime_error.
std::string state_folder(const std::string& inside = {});

/// How often a session that runs may be saved, s; a crash is to lose a minute at most.
constexpr double min_save_interval = 5, max_save_interval = 60;

/// How often the user wants it, for all studios, in $XDG_STATE_HOME/forage/settings.json; 20 s by default.
double read_save_interval();
/// Throws std::runtime_error where the file cannot be written.
void write_save_interval(double seconds);

/// The folder of a system in the user's folder of states ($XDG_STATE_HOME, or ~/.local/state), with the file
/// of the session that runs and that of one which was killed. Studios of one system have a folder each.
class RecoveryFiles {
  public:
    /// Creates and locks the folder; a file that a killed program left becomes that of the killed session.
    /// Throws std::runtime_error.
    explicit RecoveryFiles(const std::string& system);
    RecoveryFiles(RecoveryFiles&&) = default;
    RecoveryFiles& operator=(RecoveryFiles&&) = default;

    /// Writes the content of the session that runs. Throws std::runtime_error.
    void write(std::string_view content) const;
    /// The content of the killed session; empty without one. Throws CheckpointError when it is damaged.
    std::optional<std::string> killed() const;
    /// The contents of all sessions that were killed, of any system, and that no studio holds. Damaged ones
    /// are left out.
    static std::vector<std::string> all_killed();
    void forget_killed() const;
    /// The session ends as its user wants: nothing of it remains.
    void forget_running() const;

  private:
    std::string running_path() const { return folder_ + "/running.forage"; }
    std::string killed_path() const { return folder_ + "/killed.forage"; }

    std::string folder_;
    DirectoryHold hold_;
};

/// A digest of what decides a run: the system's text, or its file without one, the files that it links, and
/// the world.
std::string digest_of_files(const RunInput& input, const Sources& sources);

/// How a run was opened, in an archive; its paths become absolute.
void archive_input(Archive& archive, RunInput& input);

}  // namespace forage::studio
