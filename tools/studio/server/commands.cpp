#include "tools/studio/server/commands.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "tools/api/moves.h"
#include "tools/studio/server/command_functions.h"

namespace forage::studio {

std::uint64_t whole(const json& command, const char* member, std::uint64_t otherwise, std::uint64_t least,
                    std::uint64_t most) {
    const auto it = command.find(member);
    if (it == command.end() || it->is_null()) return otherwise;
    if (it->is_number_integer() && (it->is_number_unsigned() || it->get<std::int64_t>() >= 0)) {
        const auto value = it->get<std::uint64_t>();
        if (value >= least && value <= most) return value;
    }
    throw InputError(fmt::format("'{}' is a whole number from {} to {}", member, least, most));
}

double finite(const json& command, const char* member) {
    const double value = command.at(member).get<double>();
    if (!std::isfinite(value)) throw InputError(fmt::format("'{}' is a finite number", member));
    return value;
}

bug::World& Commands::world() { return world_of(run()); }

int Commands::group(const std::string& name) {
    Diagnostics diagnostics;
    const auto column = observe::find_column(run().layout(), name, "group", diagnostics);
    throw_errors(diagnostics);
    if (column->connection >= 0) throw InputError(fmt::format("'{}' is not a group", name));
    return column->group;
}

void Session::apply(const json& command) { Commands{*this, -1, command}.apply(); }

void Session::act(const json& command, const std::optional<json>& undo, json told) {
    repeat_actions();
    apply(command);
    ++generation_, ++version_;
    status_due_ = true;
    const std::string title = told.at("title");
    history_.act(run_->cycle(), command, title);
    if (undo) add_undo({*undo, command, title});
    told["type"] = "action", told["generation"] = generation_, told["cycle"] = run_->cycle();
    told["command"] = command.at("command"), told["undoable"] = undo.has_value();
    tell(told);
}

namespace {

struct Entry {
    json (Commands::*execute)();
    bool changes;  ///< whether it can conflict with what another page did
};

const std::map<std::string, Entry>& table() {
    static const std::map<std::string, Entry> entries = {
        {"run", {&Commands::start, false}},
        {"pause", {&Commands::pause, false}},
        {"step", {&Commands::step, false}},
        {"stop", {&Commands::stop, false}},
        {"restart", {&Commands::restart, true}},
        {"speed", {&Commands::speed, false}},
        {"open", {&Commands::open, true}},
        {"world_open", {&Commands::world_open, true}},
        {"shipped", {&Commands::shipped, false}},
        {"quit", {&Commands::quit, false}},
        {"subscribe", {&Commands::subscribe, false}},
        {"unsubscribe", {&Commands::unsubscribe, false}},
        {"read", {&Commands::read, false}},
        {"synapses", {&Commands::synapses, false}},
        {"trials", {&Commands::trials, false}},
        {"parameters", {&Commands::parameters, false}},
        {"set", {&Commands::set, true}},
        {"undo", {&Commands::undo, true}},
        {"redo", {&Commands::redo, true}},
        {"manipulate", {&Commands::manipulate, true}},
        {"revoke", {&Commands::revoke, true}},
        {"manipulations", {&Commands::manipulations, false}},
        {"patterns_read", {&Commands::patterns_read, false}},
        {"patterns_write", {&Commands::patterns_write, false}},
        {"move", {&Commands::move, true}},
        {"begin_trial", {&Commands::begin_trial, true}},
        {"sample", {&Commands::sample, false}},
        {"sample_stop", {&Commands::sample_stop, false}},
        {"layouts", {&Commands::layouts, false}},
        {"layout_read", {&Commands::layout_read, false}},
        {"layout_convert", {&Commands::layout_convert, false}},
        {"layout_write", {&Commands::layout_write, false}},
        {"panels_keep", {&Commands::panels_keep, false}},
        {"panel_read", {&Commands::panel_read, false}},
        {"panel_write", {&Commands::panel_write, false}},
        {"parameters_read", {&Commands::parameters_read, true}},
        {"parameters_write", {&Commands::parameters_write, false}},
        {"edit", {&Commands::edit, true}},
        {"item", {&Commands::item, false}},
        {"item_text", {&Commands::item_text, true}},
        {"item_check", {&Commands::item_check, false}},
        {"text_edit", {&Commands::text_edit, true}},
        {"copy", {&Commands::copy, false}},
        {"types", {&Commands::types, false}},
        {"vocabulary", {&Commands::vocabulary, false}},
        {"preview", {&Commands::preview, false}},
        {"document", {&Commands::document_read, false}},
        {"difference", {&Commands::difference, false}},
        {"new", {&Commands::new_system, true}},
        {"save", {&Commands::save, false}},
        {"backup", {&Commands::backup, false}},
        {"reload", {&Commands::reload, true}},
        {"import", {&Commands::import_process, true}},
        {"export", {&Commands::export_process, false}},
        {"recent", {&Commands::recent, false}},
        {"settings", {&Commands::settings, false}},
        {"files", {&Commands::files, false}},
        {"world_document", {&Commands::world_document, false}},
        {"world_types", {&Commands::world_types, false}},
        {"world_edit", {&Commands::world_edit, true}},
        {"world_save", {&Commands::world_save, true}},
        {"history", {&Commands::history, false}},
        {"digest", {&Commands::digest, false}},
        {"seek", {&Commands::seek, true}},
        {"branch", {&Commands::branch, true}},
        {"compare", {&Commands::compare, true}},
        {"compare_end", {&Commands::compare_end, false}},
        {"recover", {&Commands::recover, true}},
        {"forget", {&Commands::forget, false}},
    };
    return entries;
}

}  // namespace

std::vector<std::string> command_names() {
    std::vector<std::string> out;
    for (const auto& [name, entry] : table()) out.push_back(name);
    return out;
}

json execute_command(Session& session, int client, const json& command) {
    const auto name = command.at("command").get<std::string>();
    const auto it = table().find(name);
    if (it == table().end())
        throw InputError(fmt::format("there is no command '{}'", name), suggest(name, command_names()));
    if (const auto seen = command.find("generation"); it->second.changes && seen != command.end())
        if (seen->get<std::uint64_t>() != session.generation())
            throw Conflict("the run has changed since: another page has touched it");
    Commands commands{session, client, command};
    return (commands.*it->second.execute)();
}

}  // namespace forage::studio
