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

}  // namespace

std::vector<Member> arguments_of(const Command& command) {
    auto out = command.arguments;
    if (command.changes_run)
        out.push_back(optional("generation", whole(), nullptr, "Another action since is a conflict."));
    return out;
}

ValueType texts() { return list(text(), 10'000); }

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
    const auto& command = find_command(name->get_ref<const std::string&>());
    message.erase("command"), message.erase("id");
    json arguments =
        checked(std::move(message), arguments_of(command), fmt::format("command '{}'", command.name));
    if (const auto seen = arguments.find("generation"); seen != arguments.end()) {
        if (seen->get<std::uint64_t>() != session.edited.generation)
            throw Conflict("the run has changed since: another page has touched it");
        arguments.erase(seen);
    }
    return command.apply(session, Request(client, std::move(arguments)));
}

}  // namespace forage::studio
