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

#include "core/observe/recorder.h"
#include "core/run/run.h"
#include "core/run/run_spec.h"
#include "tools/api/edit/document.h"
#include "tools/studio/server/client.h"
#include "tools/studio/server/equivalents.h"
#include "tools/studio/server/history.h"
#include "tools/studio/server/recovery.h"
#include "tools/studio/server/settings.h"
#include "tools/studio/server/touches.h"

namespace forage::studio {

using nlohmann::json;

/// Executes the commands of pages between cycles, and runs the system. docs/design/studio-protocol.md
/// describes the messages. All functions are called by one thread.
class Session {
  public:
    /// Sends a message to a page: JSON, or a frame when `binary`.
    using Send = std::function<void(int client, bool binary, std::string data)>;

    /// Opens the system, also one with mistakes: its document is then corrected, and until it is, a system
    /// without content runs. `shipped` is the folder of the systems that come with Forage. Throws InputError
    /// when the file cannot be read, or something else than the system's files is wrong.
    Session(const RunInput& input, Send send, const std::string& plot_config = {}, std::string shipped = {});

    /// Keeps the session in the user's folder of states from now on, so that a killed program loses at most
    /// the time between two savings. Throws std::runtime_error.
    void keep();
    /// Goes on with the session that was killed. Throws InputError when there is none, or when it cannot go
    /// on.
    void recover();
    /// What is left of a session of this system that was killed: {"cycle", "seconds", "saved"}, the last in
    /// seconds since 1970; null without one.
    const json& killed() const { return killed_; }
    /// What was wrong with the system when it was opened; empty when it runs.
    const Diagnostics& mistakes() const { return mistakes_; }
    /// The user ends the session: nothing of it is kept.
    void end();

    void connect(int client);
    void disconnect(int client) { clients_.erase(client); }
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

    Run& run() { return *run_; }
    const RunInput& input() const { return input_; }
    bool running() const { return running_; }
    std::uint64_t generation() const { return generation_; }  ///< grows with each accepted action

    // ---- for commands and their topics (commands/) ----
    struct Undo {
        json undo, redo;  ///< commands that change the run; null when the document alone says what changes
        std::string title;
        bool document = false;      ///< whether it is a step of the document, too
        std::string merge = {};     ///< a move of the same name joins it; empty for none
        std::size_t bytes() const;  ///< of the texts that it holds
    };
    struct Change {
        std::string assignment;
        json loaded;  ///< the value of the file
    };
    using Changes = std::map<std::string, Change>;  ///< by the name of the parameter
    static json json_of_changes(const Changes& changes);
    static Changes changes_of(const json& text);
    /// A run from the same past, in step with the run. It takes the course that the run took before. It is
    /// begun as the run was, so that the past alone makes it again.
    struct Reference {
        std::uint64_t from = 0;  ///< the cycle since which they may differ
        std::unique_ptr<Run> run;
        Touches* touches = nullptr;
        History past;
        Changes changed;
    };
    /// The text of the world's file, when it is edited.
    struct WorldText {
        std::string path, text, saved;
    };
    struct Sampler {
        Sampled what;
        std::uint64_t rows = 0;
        std::optional<std::uint64_t> left;  ///< cycles
        std::optional<observe::Recorder> recorder;
    };

    /// Whether the last step is a move with this name, so that the next one joins it.
    bool joins_move(const std::string& merge) const {
        return !merge.empty() && !undo_.empty() && undo_.back().merge == merge;
    }
    void add_undo(Undo step);               ///< the last step; what was undone before cannot be done again
    void trim_undo();                       ///< drops the oldest steps
    void read_plot_config(const Run& run);  ///< throws InputError
    void save();                            ///< into the folder of states; notes what goes wrong
    void keep_anew();                       ///< under the name that the system has now
    void look_for_killed();
    struct Killed;
    /// Reads what was kept of a session. Throws InputError when it cannot go on.
    static Killed read_killed(std::string_view content);
    /// A started run of the system, with the touches of pages. Throws InputError.
    std::pair<std::unique_ptr<Run>, Touches*> make_run(const RunInput& input, std::string* files = nullptr);
    void open(RunInput input);  ///< throws InputError, and leaves the run as it is then
    void reset();               ///< opens the same system with the parameters as they are now
    void cycle();               ///< one cycle, with what follows it
    void repeat_actions();
    /// Lets the session work on the reference instead of its run.
    void swap_reference();
    /// Does something with the second run in the place of the run. When that fails, the second run ends.
    void with_reference(const std::function<void()>& act);
    void step_reference();
    void begin_reference(std::uint64_t cycle);
    /// Lets a second run with this past go beside the run, from `cycle` on. Its run is made here.
    void run_beside(Reference made, std::uint64_t cycle);
    void end_reference();
    void go_to(std::uint64_t cycle);
    void replay(std::uint64_t cycle);  ///< from the last checkpoint before it
    void rewound();
    /// Adds the parameters that were set in systems beside the document.
    void set_beside_document(RunInput& input) const;
    void rebind();  ///< subscribes for all pages anew: the run is another one
    /// Changes the run as an action says, without undo. Throws InputError.
    void apply(const json& action);
    /// Applies and notes an action, and tells the pages.
    void act(const json& action, const std::optional<json>& undo, json told);
    void tell(const json& message);
    /// An action that is not a step of undo: a recording, a file that is saved, or a run that begins anew,
    /// with which something may have ended.
    void tell_action(const std::string& command, const std::string& title, const Equivalent& forms,
                     const std::vector<std::string>& ended = {});
    json status() const;
    json trials_status() const;
    json system_message();
    json world_message();
    void close_sampler();

    // ---- the document (session_document.cpp) ----
    /// Edits the system that `input` names; what was edited before is forgotten.
    void begin_document(const RunInput& input);
    /// Opens a system, also one that cannot run or be read, as the constructor does.
    void open_any(const RunInput& input);
    /// Opens the document of a system whose files have the mistakes `found`, and runs a system without
    /// content until they are corrected. Throws InputError when nothing can be corrected in it.
    void open_with_mistakes(const RunInput& input, const Diagnostics& found);
    /// Opens another system, and tells the pages. Throws InputError, and leaves everything as it is then.
    void open_document(const RunInput& input);
    /// Makes the run what the document says, as far as that can run, and tells the pages.
    /// `script` does the same as the edit; empty for a text and for undo, which have none.
    void follow_document(const std::string& title, const Equivalent& script = {});
    /// Builds the run anew; groups and connections that did not change keep their states. Returns false, with
    /// the run as it was, when the system cannot run.
    /// At cycle 0 it begins anew, unless it `goes_on` there, too.
    bool rebuild(bool goes_on = false);
    /// What ends when the run is built anew: "past", "comparison", "recording".
    std::vector<std::string> lost_by_rebuild() const;
    /// Changes parameters in the document, too, when its items have them. Returns whether that is a step.
    bool set_in_document(const std::vector<std::string>& assignments, const std::string& title);
    /// Resolves changes of parameters of the items of a system, and leaves out others.
    std::vector<model::Assignment> assignments_in(const model::System& system,
                                                  const std::vector<std::string>& texts) const;
    /// The run has these parameters of the document.
    void note_parameters(const std::vector<std::string>& assignments);
    void tell_document();
    void note_opening();  ///< the system of the document is another one now
    /// Gives a description of parameters the values of the saved file. Returns false for an item of another
    /// file.
    bool saved_values(json& described) const;
    void look_outside();  ///< whether the file has changed
    json document_message() const;
    /// The system that pages see: that of the document, with those that run beside it.
    model::System shown_system() const;
    void set_speed(const std::string& mode, double value);
    double rate() const;  ///< cycles per second that are wanted; 0: as many as possible

    RunInput input_, begun_;          ///< as the system was opened; and with the parameters of the last stop
    std::optional<RunInput> wanted_;  ///< as a system with mistakes was opened, until it runs
    Diagnostics mistakes_;
    Send send_;
    /// Whether a path is one of a system that the page opened from those that come with Forage. They are not
    /// written, so that the next reader of the tutorial finds them as they are.
    bool comes_with_forage(const std::string& path) const;
    /// The file of the document or of the world as commands may write it: one that comes with Forage in a
    /// copy in the working directory, and none for a backup.
    EditedFile edited_file(const std::string& path) const;
    std::string shipped_;
    std::string plot_config_;  ///< the file of the layout; may be empty
    json layout_;              ///< the layout that pages begin with; null for none
    json panels_;              ///< the arrangement that a page had last; null for none
    std::unique_ptr<Run> run_;
    Touches* touches_ = nullptr;
    History history_;
    std::optional<Reference> reference_;
    std::map<int, Client> clients_;
    SourcePool sources_;
    std::vector<Undo> undo_, redo_;
    Changes changed_;
    std::optional<Sampler> sampler_;
    std::optional<Document> document_;
    std::optional<WorldText> world_text_;
    model::System built_;                      ///< the document's system that runs
    std::vector<model::System> others_;        ///< systems that run beside it
    std::vector<Document::Problem> problems_;  ///< of the document
    bool current_ = true;                      ///< whether the run is that of the document
    bool outside_ = false;                     ///< whether the file has changed outside
    double looked_at_ = -1e9;
    json sampler_waits_;    ///< the command of a sampler that begins with the run; null for none
    bool sampled_ = false;  ///< whether it has begun in this run
    Settings settings_ = read_settings();
    std::optional<RecoveryFiles> kept_;
    json killed_;
    std::string files_;  ///< digest of the files of system and world, when they were read
    std::string save_failed_;
    std::optional<std::uint64_t> saved_version_;
    double saved_at_ = -1e9;

    bool running_ = false, status_due_ = true;
    std::optional<std::size_t> pause_after_trials_;  ///< the number of finished trials of the first robot
    std::string mode_ = "real", failed_;
    double value_ = 1;
    std::uint32_t epoch_ = 1;
    std::uint64_t generation_ = 0, version_ = 0;
    std::int64_t opened_ = 0;  ///< ms since 1970; another number says that the system is another one
    double pace_from_ = -1, status_at_ = -1, frames_at_ = -1;
    std::uint64_t pace_cycle_ = 0;
    double rate_from_ = -1, measured_rate_ = 0;
    double pages_time_ = 0, pages_share_ = 0;  ///< s since rate_from_, and of the last measured time
    double rows_time_ = 0;                     ///< s of a cycle for streams of every cycle
    std::uint64_t rate_cycle_ = 0;
};

}  // namespace forage::studio
