// A command of a page as a value.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/api/edit/schema.h"
#include "tools/studio/server/equivalents.h"
#include "tools/studio/server/session.h"

namespace forage::studio {

using namespace schema;  // NOLINT(google-build-using-namespace): the words in which commands are declared

/// The arguments of a command, which have been checked. A member with a default always has a value.
class Request {
  public:
    Request(int page, json arguments) : client(page), arguments_(std::move(arguments)) {}

    const int client;  ///< the page; -1 for none
    bool has(const char* member) const { return arguments_.contains(member); }
    const json& operator[](const char* member) const { return arguments_.at(member); }
    const std::string& text(const char* member) const {
        return arguments_.at(member).get_ref<const std::string&>();
    }
    /// A list of texts; empty when it is absent.
    std::vector<std::string> texts(const char* member) const {
        return has(member) ? arguments_.at(member).get<std::vector<std::string>>()
                           : std::vector<std::string>();
    }
    std::uint64_t whole(const char* member) const { return arguments_.at(member).get<std::uint64_t>(); }
    double number(const char* member) const { return arguments_.at(member).get<double>(); }
    bool flag(const char* member) const { return arguments_.at(member).get<bool>(); }
    const json& all() const { return arguments_; }

  private:
    json arguments_;
};

struct Command {
    std::string name;
    std::string doc;  ///< one or two sentences, for the table of docs/design/studio-protocol.md
    std::vector<Member> arguments = {};
    std::string result = "{}";  ///< as TypeScript, with the types of web/src/protocol
    /// Whether it is rejected when another page acted since the `generation` that it names.
    bool changes_run = false;
    json (*apply)(Session& session, const Request& request) = nullptr;
    /// Of an action that the history repeats: changes the run as the noted action says.
    void (*repeat)(Course& course, const json& action) = nullptr;
    /// The action that undoes such an action, before it is applied. Throws InputError for one that is wrong.
    json (*inverse)(Session& session, const json& action) = nullptr;
    /// How to do such an action without the studio, before it is applied. Actions that are not repeated give
    /// theirs when they are logged (LoggedAction).
    Equivalent (*script)(Session& session, const json& action) = nullptr;
};

/// The arguments that a command accepts: its own, and the `generation` of one that changes the run.
std::vector<Member> arguments_of(const Command& command);
/// A list of names or assignments; many more of them would block the engine.
ValueType texts();

/// All commands, topic by topic.
const std::vector<Command>& commands();
/// Throws InputError for a name that no command has.
const Command& find_command(const std::string& name);

/// The commands of a topic, each in the file of its name.
std::vector<Command> run_commands();
std::vector<Command> looking_commands();
std::vector<Command> figure_commands();
std::vector<Command> parameter_commands();
std::vector<Command> undo_commands();
std::vector<Command> intervening_commands();
std::vector<Command> sampling_commands();
std::vector<Command> layout_commands();
std::vector<Command> panel_commands();
std::vector<Command> editing_commands();
std::vector<Command> document_commands();
std::vector<Command> world_commands();
std::vector<Command> past_commands();

}  // namespace forage::studio
