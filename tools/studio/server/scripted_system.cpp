#include "tools/studio/server/scripted_system.h"

#include <algorithm>
#include <exception>

#include "core/model/changes.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/xml/patch.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/api/operations.h"
#include "tools/api/text_parts.h"

namespace forage::studio {
namespace {

using nlohmann::json;

/// The operations that give a system the parameters of another one, and switch its modules on or off as
/// there; without those that need more than that.
json parameter_operations(model::System before, const model::System& after, const Registry& registry) {
    json out = json::array();
    for (auto& process : before.processes) {
        const auto it = std::ranges::find(after.processes, process.id, &model::Process::id);
        if (it == after.processes.end() || it->module_enabled == process.module_enabled) continue;
        process.module_enabled = it->module_enabled;
        out.push_back(
            {{"do", "set"}, {"id", process.id}, {"property", "enabled"}, {"value", it->module_enabled}});
    }
    const auto changes = model::parameter_changes(before, after, registry);
    for (const auto& change : changes.value_or(std::vector<model::Assignment>())) {
        const auto& settings = model::find_use(after, change.id)->settings;
        const auto it = std::ranges::find(settings, change.parameter->name, &model::Setting::name);
        out.push_back({{"do", "parameter"},
                       {"id", change.id},
                       {"name", change.parameter->name},
                       {"value", it == settings.end() ? json() : json(it->value)}});
    }
    return out;
}

void carry_out_all(const json& operations, model::System& system, const Registry& registry,
                   const std::string& path) {
    for (const auto& o : operations) editing::carry_out(o, system, registry, path);
}

/// The text of a file after operations; empty when it cannot have them.
std::string text_after(const json& operations, const std::string& text, const std::string& path,
                       const Registry& registry) {
    try {
        auto document = Document::unsaved(path, text);
        document.edit([&](model::System& system) { carry_out_all(operations, system, registry, path); },
                      "edit");
        return document.text();
    } catch (const std::exception&) {
        return {};
    }
}

/// A system whose connections leave out as much as those of another one.
model::System as_terse_as(const model::System& other, model::System system) {
    for (auto& c : system.connections) {
        const auto it = std::ranges::find(other.connections, c.id, &model::Connection::id);
        if (it != other.connections.end()) c.terse = it->terse;
    }
    return system;
}

/// The parts in which two texts differ, as operations.
json parts(const std::string& before, const std::string& after) {
    return before == after ? json::array() : json::array({editing::replace_operation(before, after)});
}

}  // namespace

void ScriptedSystem::begin(const Document& document) {
    Diagnostics ignored;
    auto saved = xml::parse_system(document.path(), document.saved_text(), ignored);
    text_ = saved ? document.saved_text() : std::string();
    system_ = saved ? *std::move(saved) : model::System();
    follows_ = text_ == document.text();
}

ScriptedSystem::Operations ScriptedSystem::follow(const std::string& before, const json& operations,
                                                  const Document& now, const Registry& registry) {
    // `replace` means the text of the file in the shell, and what the model writes in the studio.
    const bool is_text =
        std::ranges::any_of(operations, [](const auto& o) { return o.value("do", "") == "replace"; });
    const json given = is_text ? json::array() : operations;
    json all = given;
    model::System scripted = system_;
    bool same = false;
    try {
        carry_out_all(given, scripted, registry, now.path());
        const auto set = parameter_operations(scripted, now.system(), registry);
        carry_out_all(set, scripted, registry, now.path());
        all.insert(all.end(), set.begin(), set.end());
        // An edit of the text alone may be one of comments, which the content leaves out.
        const bool by_content = !given.empty() && text_ == before;
        same = !all.empty() && xml::same_content(scripted, now.system()) &&
               (by_content ||
                xml::write_system(scripted) == xml::write_system(as_terse_as(scripted, now.system())));
    } catch (const std::exception&) {  // what an operation needs has gone since
    }
    Operations out;
    const bool is_known = text_ == before && all == given;
    if (same && (is_known || text_after(all, text_, now.path(), registry) == now.text()))
        out.in_shell = all;
    else
        out.in_shell = parts(text_, now.text());
    if (!same) scripted = as_terse_as(system_, now.system());
    out.in_python = same ? all : parts(xml::write_system(system_), xml::write_system(scripted));
    follows_ = is_short(out.in_shell) && is_short(out.in_python);
    if (is_short(out.in_shell)) text_ = now.text();
    if (is_short(out.in_python)) system_ = std::move(scripted);
    return out;
}

Equivalent ScriptedSystem::edit(const EditedFile& file, const std::string& before, const json& operations,
                                const Document& now, const Registry& registry) {
    if (!now.readable() || text_.empty()) return {};
    const auto all = follow(before, operations, now, registry);
    return of_edit(file, all.in_shell, all.in_python);
}

bool ScriptedSystem::has_all_but_parameters(const Document& now, const Registry& registry) const {
    return text_.empty() || text_ == now.text() ||
           text_after(parameter_operations(system_, now.system(), registry), text_, now.path(), registry) ==
               now.text();
}

Equivalent ScriptedSystem::save(const EditedFile& file, const Document& now, const std::string& to,
                                const Registry& registry) {
    if (!now.readable()) return {};
    if (text_.empty()) return of_saved(to);
    const auto all = follow({}, json::array(), now, registry);
    auto out = of_save(file, to, all.in_shell, all.in_python);
    if (!is_short(all.in_python)) {
        out.python = of_saved(to).python;
        system_ = now.system();
    }
    if (!now.path().empty()) model::move_files(system_, now.path(), to, registry);
    return out;
}

void ScriptedSystem::note_saved(const Document& saved) {
    if (!saved.readable() || text_.empty()) return begin(saved);
    text_ = saved.text(), follows_ = true;
}

}  // namespace forage::studio
