// A session of the studio: a run, and the pages that watch and touch it. It knows no sockets and no threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/run/run.h"
#include "core/run/run_spec.h"
#include "tools/studio/server/edited_system.h"
#include "tools/studio/server/live_run.h"
#include "tools/studio/server/pages.h"
#include "tools/studio/server/recovery.h"

namespace forage::studio {

using nlohmann::json;

/// What is saved of a session in case its program is killed, and what is left of one that was killed.
struct RecoveryState {
    std::optional<RecoveryFiles> files;
    json killed;
    std::string failed;                    ///< why the session cannot be saved
    std::optional<std::uint64_t> version;  ///< of the run when it was saved
    double saved_at = -1e9;
    std::size_t length = 0;  ///< bytes that were saved last; the next ones are about as many
    double save_interval = read_save_interval();
};

/// An action as pages log it.
struct LoggedAction {
    std::string command = {}, title = {};
    Equivalent scripts = {};
    std::vector<std::string> ended = {};  ///< with the run before: "past", "comparison", "recording"
    std::string item = {};                ///< the group that it acts on
    json values = nullptr;                ///< of parameters that it sets
    std::string failed = {};              ///< why a recording or a comparison has ended
};

/// Executes the commands of pages between cycles, and runs the system. docs/design/studio-protocol.md
/// describes the messages. All functions are called by one thread.
class Session {
  public:
    using Send = Pages::Send;

    /// Opens the system, also one with mistakes: its document is then corrected, and until it is, a system
    /// without content runs. `shipped` is the folder of the systems that come with Forage. Throws InputError
    /// when the file cannot be read, or something else than the system's files is wrong.
    Session(const RunInput& input, Send send, const std::string& plot_config = {}, std::string shipped = {});

    /// Keeps the session in the user's folder of states from now on, so that a killed program loses at most
    /// the time between two savings. Throws std::runtime_error.
    void keep();
    /// Saves what has changed since it was saved, for a session that may end now.
    void save_changes();
    /// Continues the session that was killed. Throws InputError when there is none, or when it cannot go
    /// on.
    void recover();
    /// What is left of a session of this system that was killed: {"cycle", "seconds", "saved"}, the last in
    /// seconds since 1970; null without one.
    const json& killed() const { return recovery.killed; }
    /// What was wrong with the system when it was opened; empty when it runs.
    const Diagnostics& mistakes() const { return edited.mistakes; }
    /// The user ends the session: nothing of it is kept. Throws std::runtime_error when its recording is not
    /// complete.
    void end();

    void connect(int client);
    void disconnect(int client) { pages.clients.erase(client); }
    /// Executes the command in a message of a page, and replies.
    void message(int client, std::string_view text);
    /// Executes a command of a page (of none: -1), and returns the reply without its number.
    json execute(int client, const json& command);

    /// Runs the cycles that are due, for a few milliseconds, and sends frames and status. Returns the seconds
    /// until it should be called again, without commands; `now` is the time of a steady clock, s.
    double work(double now);

    /// A picture of the run as the content of a file. Throws InputError.
    std::string picture(const std::string& what, const std::string& format);

    /// Ends the program for a page that asks for it; empty when it cannot.
    std::function<void()> quit;
    /// The address at which pages find the picture of a version of the world, or of its floors.
    std::function<std::string(const std::string& what, const std::string& version)> picture_address;

    Run& run() { return *live.run; }

    // ---- for commands ----
    LiveRun live;
    EditedSystem edited;
    Pages pages;
    RecoveryState recovery;

    void note_use() const;    ///< among the latest files, with its world and its seed
    void restart_autosave();  ///< under the name that the system has now
    void reset();             ///< opens the same system with the parameters as they are now
    void cycle();             ///< one cycle, with what follows it
    /// A copy of the run in the state of the last checkpoint before `cycle`, with the past up to it.
    Course copy_at(std::uint64_t cycle);
    /// Lets a second run with the same past go beside the run, from `cycle` on.
    void begin_reference(std::uint64_t cycle);
    void end_reference();
    void go_to(std::uint64_t cycle);
    /// Changes the run as an action says, notes it in the history, and logs it with its scripts. Throws
    /// InputError.
    void act(const json& action, LoggedAction logged);
    void log(const LoggedAction& action);
    json status() const;
    /// The hits among the finished trials of the first robot, of a run that has trials.
    const HitCounts& hits() const;
    json system_message();
    json world_message();
    /// Ends the recording, because it `failed` or for another reason. Returns what went wrong; empty when
    /// its file is complete.
    std::string close_sampler(std::string failed = {});

    // ---- the document (session_document.cpp) ----
    /// Opens another system, and tells the pages. Throws InputError, and leaves everything as it is then.
    void open_document(const RunInput& input);
    /// Makes the run what the document says, as far as that can run, and tells the pages.
    /// `script` does the same as the edit; empty for a text and for undo, which have none.
    void follow_document(const std::string& title, const Equivalent& script = {});
    /// Rebuilds the run; groups and connections that did not change keep their states. Returns false, with
    /// the run as it was, when the system cannot run.
    /// At cycle 0 it restarts, unless it `continues` there, too. It has no past, unless it `keeps_past`.
    bool rebuild(bool continues = false, bool keeps_past = false);
    /// What ends when the run is rebuilt: "past", "comparison", "recording".
    std::vector<std::string> lost_by_rebuild() const;
    /// Changes parameters in the document, too, when its items have them. Returns whether its text changed.
    bool set_in_document(const std::vector<std::string>& assignments);
    /// The run has these parameters of the document.
    void note_parameters(const std::vector<std::string>& assignments);
    void broadcast_document();
    /// Gives a description of parameters the values of the saved file. Returns false for an item of another
    /// file.
    bool saved_values(json& described) const;
    void check_file_on_disk();  ///< whether the file has changed
    json document_message() const;
    /// The system that pages see: that of the document, with those that run beside it.
    model::System shown_system() const;
    void set_speed(const std::string& mode, double value);

    /// Whether a path is one of a system that the page opened from those that come with Forage. They are not
    /// written, so that the next reader of the tutorial finds them as they are.
    bool comes_with_forage(const std::string& path) const;
    const std::string& shipped() const { return shipped_; }
    /// Returns a file that may be written: a shipped file is redirected to a copy in the working directory. A
    /// backup is read-only, so its path becomes empty.
    EditedFile edited_file(const std::string& path) const;

  private:
    // ---- the run ----
    void read_plot_config(const Run& run);  ///< throws InputError
    void open(RunInput input);              ///< throws InputError, and leaves the run as it is then
    /// Makes the run of a reference, which has a past only, and repeats this past up to `cycle`.
    void run_beside(Reference reference, std::uint64_t cycle);
    void replay(std::uint64_t cycle);
    /// Computes cycles of the run, which has failed when this throws.
    void compute(const std::function<void()>& cycles);
    /// Computes cycles of the second run, if there is one. It ends when this fails, and the run continues.
    void compute_beside(const std::function<void(Course&)>& cycles);
    void feed_streams();  ///< with the numbers of the last cycle, for streams of every cycle
    void record_cycle();  ///< adds the last cycle to the recording, which ends when this fails
    void rewound();
    /// Adds the parameters that were set in systems beside the document.
    void set_beside_document(RunInput& input) const;
    json trials_status() const;

    // ---- recovery (session_recovery.cpp) ----
    void save();  ///< into the folder of states; notes what goes wrong
    void look_for_killed();
    struct Killed;
    /// Reads what was kept of a session. Throws InputError when it cannot continue.
    static Killed read_killed(std::string_view content);

    // ---- the document (session_document.cpp) ----
    /// What is wrong with the document, and with the files that its modules name.
    std::vector<Document::Problem> find_problems() const;
    /// Edits the system that `input` names; what was edited before is forgotten.
    void begin_document(const RunInput& input);
    /// Opens a system, also one that cannot run or be read, as the constructor does.
    void open_any(const RunInput& input);
    /// Opens the document of a system whose files have the mistakes `found`, and runs a system without
    /// content until they are corrected. Throws InputError when nothing can be corrected in it.
    void open_with_mistakes(const RunInput& input, const Diagnostics& found);
    /// Resolves changes of parameters of the items of a system, and leaves out others.
    std::vector<model::Assignment> assignments_in(const model::System& system,
                                                  const std::vector<std::string>& texts) const;
    void note_opening();  ///< the system of the document is another one now

    double rows_time_ = 0;     ///< s of a cycle for streams of every cycle
    std::string shipped_;      ///< the folder of the systems that come with Forage
    std::string plot_config_;  ///< the file of the layout; may be empty
};

}  // namespace forage::studio
