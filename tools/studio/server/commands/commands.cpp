#include "tools/studio/server/commands.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/studio/server/commands/command.h"

namespace forage::studio {
namespace {

using Topic = std::vector<Command> (*)();
constexpr Topic topics[] = {run_commands,    looking_commands,     figure_commands,   parameter_commands,
                            undo_commands,   intervening_commands, sampling_commands, panel_commands,
                            layout_commands, past_commands,        editing_commands,  document_commands,
                            world_commands};

/// Removes the generation that a command names. Throws Conflict when it is not the present one.
void take_generation(const Session& session, const Command& command, json& arguments) {
    const auto seen = arguments.find("generation");
    if (!command.changes_run || seen == arguments.end()) return;
    if (const auto found = mismatch(*seen, whole(), "generation"))
        throw InputError(fmt::format("command '{}': '{}' {}", command.name, found->where, found->what),
                         found->allowed);
    if (seen->get<std::uint64_t>() != session.generation())
        throw Conflict("the run has changed since: another page has touched it");
    arguments.erase(seen);
}

}  // namespace

const std::vector<Command>& commands() {
    static const std::vector<Command> all = [] {
        std::vector<Command> out;
        for (const auto topic : topics)
            for (auto& command : topic()) out.push_back(std::move(command));
        return out;
    }();
    return all;
}

const Command& find_command(const std::string& name) {
    if (const auto* found = find_by(commands(), name, &Command::name)) return *found;
    throw InputError(fmt::format("there is no command '{}'", name), suggest(name, names_of(commands())));
}

json execute_command(Session& session, int client, json message) {
    const auto name = message.find("command");
    if (name == message.end() || !name->is_string())
        throw InputError("'command' is missing in the message", R"(such as {"id": 1, "command": "run"})");
    const auto& command = find_command(name->get<std::string>());
    message.erase("command"), message.erase("id");
    take_generation(session, command, message);
    const std::string what = fmt::format("command '{}'", command.name);
    return command.apply(session, Request(client, checked(std::move(message), command.arguments, what)));
}

}  // namespace forage::studio
