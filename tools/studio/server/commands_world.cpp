#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/world/sdf_edit.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tools/studio/server/command_functions.h"

namespace forage::studio {
namespace {

json json_of(const bug::WorldItem& i) {
    return {{"name", i.name}, {"kind", i.kind}, {"uri", i.uri}, {"x", i.x},
            {"y", i.y},       {"z", i.z},       {"yaw", i.yaw}, {"size", i.size}};
}

/// Carries out an operation on the text of a world. Returns the name of what is added, or null.
json carry_out_in_world(const json& o, std::string& text) {
    const auto what = o.at("do").get<std::string>();
    const auto name = o.value("name", "");
    if (what == "add") {
        bug::NewItem item{.kind = o.at("kind"), .name = name, .x = o.at("x"), .y = o.at("y")};
        item.yaw = o.value("yaw", item.yaw), item.width = o.value("width", item.width);
        item.depth = o.value("depth", item.depth), item.radius = o.value("radius", item.radius);
        item.color = o.value("color", item.color), item.uri = o.value("uri", item.uri);
        std::string made;
        text = bug::add_to_world(text, std::move(item), made);
        return made;
    }
    if (what == "move") {
        const auto yaw = o.find("yaw");
        text = bug::moved_in_world(
            text, name, o.at("x"), o.at("y"),
            yaw == o.end() || yaw->is_null() ? std::nullopt : std::optional(yaw->get<double>()));
    } else if (what == "resize") {
        text = bug::resized_in_world(text, name, o.at("size").get<std::vector<double>>());
    } else if (what == "rename") {
        text = bug::renamed_in_world(text, name, o.at("to").get<std::string>());
    } else if (what == "remove") {
        text = bug::removed_from_world(text, name);
    } else {
        throw InputError(fmt::format("there is no operation '{}'", what),
                         "add, move, resize, rename or remove");
    }
    return nullptr;
}

}  // namespace

Session::WorldText& Commands::world_text() {
    if (!s.world_text_) {
        if (s.input_.world.empty()) throw InputError("the system has no world", "open it with a world");
        s.world_text_ = {s.input_.world, read_file(s.input_.world), {}};
        s.world_text_->saved = s.world_text_->text;
    }
    return *s.world_text_;
}

json Commands::world_document() {
    const auto& world = world_text();
    json items = json::array();
    for (const auto& i : bug::items_of_world(world.text)) items.push_back(json_of(i));
    return {{"type", "world_document"},
            {"file", world.path},
            {"dirty", world.text != world.saved},
            {"items", std::move(items)}};
}

json Commands::world_types() { return {{"kinds", bug::kinds_of_items()}}; }

json Commands::world_edit() {
    const auto& operations = c.at("operations");
    if (!operations.is_array() || operations.empty()) throw InputError("there is no operation");
    std::string text = world_text().text;
    json names = json::array();
    for (const auto& o : operations) names.push_back(carry_out_in_world(o, text));
    Diagnostics diagnostics;
    bug::check_world_text(world_text().path, text, diagnostics);
    throw_errors(diagnostics);
    const auto title =
        c.value("title", fmt::format("{} in the world", operations.front().value("do", "edit")));
    const auto merge = c.value("merge", "");
    const json redo = {{"command", "world_text"}, {"text", text}, {"merge", merge}};
    const bool joins = !merge.empty() && !s.undo_.empty() && s.undo_.back().redo.is_object() &&
                       s.undo_.back().redo.value("command", "") == "world_text" &&
                       s.undo_.back().redo.value("merge", "") == merge;
    if (joins)
        s.undo_.back().redo = redo;
    else
        s.add_undo({{{"command", "world_text"}, {"text", world_text().text}}, redo, title, false});
    s.redo_.clear();
    set_world_text(text);
    return {{"names", std::move(names)}, {"generation", s.generation_}};
}

void Commands::set_world_text(const std::string& text) {
    world_text().text = text;
    ++s.generation_;
    s.tell(world_document());
    s.tell_document();  // what can be undone
}

json Commands::world_save() {
    auto& world = world_text();
    const auto file = c.value("file", world.path);
    if (std::filesystem::path(file).extension() != ".world")
        throw InputError(fmt::format("'{}' is not a name of a world", file), "it ends with .world");
    if (!c.value("overwrite", false)) {
        if (file == world.path && read_file(file) != world.saved)
            throw InputError(fmt::format("'{}' was changed outside since it was read", file), "overwrite it");
        if (file != world.path && std::filesystem::exists(file))
            throw InputError(fmt::format("'{}' exists", file), "overwrite it, or choose another name");
    }
    write_file(file, world.text);
    world.saved = world.text, world.path = file;
    const auto before = std::exchange(s.input_.world, file);
    try {
        s.reset();  // the run begins anew in the world as it is now
    } catch (...) {
        s.input_.world = before;
        throw;
    }
    s.tell(s.world_message()), s.tell(world_document());
    return {{"file", file}};
}

}  // namespace forage::studio
