// Steps that commands of several topics share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/studio/server/commands/command.h"

namespace forage::studio {

// ---- files ----
/// The folder of the system.
std::filesystem::path system_folder(const Session& session);
/// Throws InputError for a file that comes with Forage.
void refuse_shipped(const Session& session, const std::string& path);

// ---- the run ----
std::size_t find_robot(Session& session, const Request& request);
/// Begins the run again with another input; with the one before when that fails.
void reset_with(Session& session, RunInput input);
/// The scripts of a run of the document that begins again in a world.
Equivalent begun_again(const Session& session, Equivalent (*form)(const Opened&), const std::string& world);
/// Begins a recording that was asked to begin with the run.
void begin_waiting_sampler(Session& session);

// ---- parameters ----
/// Checks assignments and returns those that undo them. Throws InputError for all mistakes at once.
std::vector<std::string> inverse(Session& session, const std::vector<std::string>& assignments);
json set_parameters(Session& session, const std::vector<std::string>& assignments, const std::string& title);
/// Whether the run takes an assignment only when it begins again.
bool waits_for_start(Session& session, const std::string& assignment);
/// Whether an assignment switches a module on or off, which the description of the system says.
bool switches_module(const std::vector<std::string>& assignments);
json describe_item_parameters(Session& session, const std::string& item);

// ---- steps of undo ----
/// Carries out an action of the run as a step. `step` holds what else it has changed, and its `merge`.
json take_step(Session& session, const json& action, LoggedAction logged, UndoStep step = {});
/// Carries out operations on the system as one step; an empty title is that of the first one. Returns what
/// they have made, the generation, and warnings.
json edit_document(Session& session, const json& operations, std::string title = {},
                   const std::string& merge = {});
/// Follows a step of the document, which holds the text before. `script` is empty for an edit of the text.
json follow_edit(Session& session, UndoStep step, const Equivalent& script = {});

// ---- the text of the world ----
WorldText& world_text(Session& session);
json describe_world_text(Session& session);
void set_world_text(Session& session, const std::string& text);
/// Builds the run again in a world of this text: robots and what they carry stay where they are. Throws
/// InputError, and leaves the run as it is then.
void run_in_world(Session& session, const std::string& text);
std::string running_world(Session& session);  ///< the text of the world that runs
/// Logs an edit of the world; the run continues in the edited world, or not.
void log_world_edit(Session& session, LoggedAction logged, bool runs);

}  // namespace forage::studio
