#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "bug_interface/world/sdf_edit.h"
#include "core/base/number.h"
#include "core/base/output_files.h"
#include "core/base/sequence.h"
#include "core/base/text_file.h"
#include "tools/api/edit/world_operations.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

json json_of(const bug::ItemProperty& p) {
    const auto limit = [](const std::optional<double>& v) { return v ? json(*v) : json(nullptr); };
    json value = p.value;
    if (p.kind == "number" || p.kind == "integer") value = parse_number<double>(p.value).value_or(0);
    if (p.kind == "boolean") value = p.value == "1";
    return {
        {"name", p.name},      {"label", p.label},      {"kind", p.kind},      {"value", std::move(value)},
        {"low", limit(p.low)}, {"high", limit(p.high)}, {"choices", p.choices}};
}

json json_of(const bug::WorldItem& i) {
    const auto part = [](const auto& p) {
        return json{{"x", p.x}, {"y", p.y}, {"yaw", p.yaw}, {"size", p.size}, {"color", p.color}};
    };
    return {{"id", i.id},
            {"name", i.name},
            {"kind", i.kind},
            {"placed", i.placed},
            {"unpacks", i.unpacks},
            {"x", i.x},
            {"y", i.y},
            {"z", i.z},
            {"yaw", i.yaw},
            {"parts", collected(i.parts, part)},
            {"properties", collected(i.properties, [](const auto& p) { return json_of(p); })}};
}

/// The ids that an operation has made: one, several or none.
json flat(json made) {
    if (made.is_null()) return json::array();
    return made.is_array() ? made : json::array({std::move(made)});
}

json edit_world(Session& s, const Request& r) {
    const auto& operations = r["operations"];
    if (operations.empty()) throw InputError("there is no operation");
    const std::string before = world_text(s).text;
    std::string text = before;
    bug::ModelTexts models(world_text(s).path);
    json ids = json::array();
    for (const auto& o : operations)
        for (auto& id : flat(editing::carry_out_in_world(o, text, models))) ids.push_back(std::move(id));
    editing::check_world(world_text(s).path, text);
    const auto title = r.has("title")
                           ? r.text("title")
                           : fmt::format("{} in the world", operations.front().value("do", "edit"));
    const bool runs = r.flag("run");
    const auto ended = s.lost_by_rebuild();
    UndoStep step{.title = title, .merge = r.text("merge"), .world = WorldTexts{before, {}}};
    if (runs) {
        // What else was edited on the map gets into the run when the world is saved.
        std::string running = running_world(s);
        step.world->running = running;
        for (const auto& o : operations) {
            if (o.at("do") != "move")
                throw InputError("only what is moved gets into the run at once", "save the world");
            editing::carry_out_in_world(o, running, models);
        }
        run_in_world(s, running);
    }
    s.edited.steps.add(std::move(step));
    set_world_text(s, text);
    log_world_edit(s,
                   {.title = title,
                    .scripts = of_world_edit(s.edited_file(world_text(s).path), operations),
                    .ended = ended},
                   runs);
    return {{"ids", std::move(ids)}, {"generation", s.edited.generation}};
}

/// The operations that let a world which is called as its file be called as the file `to`.
json renaming(const WorldText& world, const std::string& to, bug::ModelTexts& models) {
    const auto stem = [](const std::string& path) { return std::filesystem::path(path).stem().string(); };
    const auto items = bug::items_of_world(world.text, models);
    const auto it = std::ranges::find(items, "world", &bug::WorldItem::kind);
    if (it == items.end() || it->name != stem(world.path) || contains(items, stem(to), &bug::WorldItem::name))
        return json::array();
    return {{{"do", "set"}, {"id", it->id}, {"property", "name"}, {"value", stem(to)}}};
}

json save_world(Session& s, const Request& r) {
    auto& world = world_text(s);
    const auto file = r.has("file") ? r.text("file") : world.path;
    check_writable(s, file, FileKind::world, r.flag("overwrite") || file == world.path);
    if (file == world.path && !r.flag("overwrite") && read_file(file) != world.saved)
        throw FileExists(fmt::format("'{}' was changed outside since it was read", file), "overwrite it");
    bug::ModelTexts models(world.path);
    const auto renamed = renaming(world, file, models);
    std::string text = world.text;
    for (const auto& o : renamed) editing::carry_out_in_world(o, text, models);
    RunInput wanted = s.live.begun;  // with the text that the system had: its file may have changed
    wanted.world = file, wanted.world_text = text;
    open_run(wanted);  // a world in which the system cannot run is not written
    auto forms = begun_again(s, of_world, file);
    if (file != world.path) {
        const auto copy = of_world_copy(s.edited_file(world.path), renamed, file);
        forms = copy + forms;
    }
    write_file(file, text);
    world.text = world.saved = text, world.path = file;
    RunInput input = s.edited.input;
    input.world = file, input.world_text.clear();
    const auto ended = s.lost_by_rebuild();
    reset_with(s, std::move(input));
    const auto name = std::filesystem::path(file).filename().string();
    s.log({.command = "world_save",
           .title = "save " + name + " and restart in it",
           .scripts = forms,
           .ended = ended});
    s.pages.broadcast(s.world_message()), s.pages.broadcast(describe_world_text(s));
    return {{"file", file}};
}

json list_kinds(Session&, const Request&) {
    const auto kind = [](const auto& k) {
        return json{{"kind", k.kind}, {"title", k.title}, {"group", k.group}};
    };
    return {{"kinds", collected(bug::kinds_of_items(), kind)}};
}

}  // namespace

WorldText& world_text(Session& s) {
    if (!s.edited.world_text) {
        if (s.edited.input.world.empty()) throw InputError("the system has no world", "open it with a world");
        s.edited.world_text = {s.edited.input.world, read_file(s.edited.input.world), {}};
        s.edited.world_text->saved = s.edited.world_text->text;
    }
    return *s.edited.world_text;
}

std::string running_world(Session& s) {
    return s.edited.input.world_text.empty() ? world_text(s).saved : s.edited.input.world_text;
}

json describe_world_text(Session& s) {
    const auto& world = world_text(s);
    bug::ModelTexts models(world.path);
    return {{"type", "world_document"},
            {"file", world.path},
            {"dirty", world.text != world.saved},
            {"shipped", s.comes_with_forage(world.path)},
            {"problems", problems_of(editing::problems_of_world(world.path, world.text))},
            {"items",
             collected(bug::items_of_world(world.text, models), [](const auto& i) { return json_of(i); })}};
}

void set_world_text(Session& s, const std::string& text) {
    world_text(s).text = text;
    ++s.edited.generation;
    s.recovery.version.reset();  // it is kept for the case of a crash, also while nothing runs
    s.pages.broadcast(describe_world_text(s));
    s.broadcast_document();  // what can be undone
}

void run_in_world(Session& s, const std::string& text) {
    if (!s.edited.current)
        throw InputError("the system has problems", "correct them first; the run keeps its world");
    const auto before = std::exchange(s.edited.input.world_text, text);
    const auto problems = s.edited.problems;
    if (s.rebuild(true)) return;
    const auto found = std::exchange(s.edited.problems, problems);
    s.edited.input.world_text = before;
    for (const auto& p : found)
        if (p.diagnostic.severity == Severity::error)
            throw InputError(p.diagnostic.message, "the run keeps its world");
    throw InputError("the system cannot run in this world", "the run keeps its world");
}

void log_world_edit(Session& s, LoggedAction logged, bool runs) {
    logged.command = "world_edit";
    if (runs)
        ++s.live.version;
    else
        logged.ended.clear();
    s.log(logged);
    if (runs) s.pages.broadcast(s.world_message());
}

std::vector<Command> world_commands() {
    return {
        {.name = "world_document",
         .doc = "Returns the message `world_document`.",
         .result = "WorldDocument",
         .apply = [](Session& s, const Request&) { return describe_world_text(s); }},
        {.name = "world_types",
         .doc = "Lists what the operation `add` makes.",
         .result = "{ kinds: WorldKind[] }",
         .apply = list_kinds},
        {.name = "world_edit",
         .doc = "Carries out [operations on the world](#the-text-of-the-world), all of them or none. Returns "
                "the ids "
                "of what is added or changed. Its `action` has `ended`, which is empty without `run`.",
         .arguments = {{"operations", list(record({}, "WorldOperation"))},
                       optional("title", text()),
                       optional("merge", text(), "", "joins the step before when that has the same name"),
                       optional("run", boolean(), false,
                                "whether the run continues in its world with what these operations `move`")},
         .result = "{ ids: string[]; generation: number }",
         .changes_run = true,
         .apply = edit_world},
        {.name = "world_save",
         .doc = "Saves the world and begins the run again in it. Rejected when the system cannot run in it, "
                "and for a world that comes with Forage.",
         .arguments = {optional("file", path(), nullptr, "`.world`; by default the same"),
                       optional("overwrite", boolean(), false)},
         .result = "{ file: string }",
         .changes_run = true,
         .apply = save_world},
    };
}

}  // namespace forage::studio
