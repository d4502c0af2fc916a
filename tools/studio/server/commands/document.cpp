#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/model/build.h"
#include "core/xml/writer.h"
#include "tools/studio/server/backups.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/recent.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_text = 4u << 20;  ///< bytes of a text that a page edits

/// What a page opens or writes: systems, worlds, and what is beside them.
bool is_shown(const fs::path& file) {
    constexpr std::string_view endings[] = {".iqr",  ".iqrProcess", ".world", ".sdf",  ".xml",
                                            ".conf", ".hconf",      ".pconf", ".json", ".csv",
                                            ".dat",  ".h5",         ".npy",   ".txt"};
    return std::ranges::find(endings, file.extension().string()) != std::end(endings);
}

json read_document(Session& s, const Request&) {
    s.check_file_on_disk();
    const auto& text = s.edited.document->text();
    if (text.size() > max_text)
        throw InputError(fmt::format("the text has {} MB, too many for a page", text.size() >> 20),
                         "open the file in an editor; the studio notices when it changes");
    json out = s.document_message();
    out["text"] = text, out["generation"] = s.edited.generation;
    return out;
}

json open_new_system(Session& s, const Request& r) {
    RunInput input = s.edited.input;
    input.more.clear(), input.settings.clear(), input.robots.clear(), input.replay.clear();
    const auto& from = r.text("from");
    const Document made = from.empty() ? Document::create(r.text("name"))
                                       : Document::create(r.text("name"), read_file(shipped_path(s, from)));
    input.text = made.text();
    input.system = "untitled.iqr";
    input.world = r.text("world"), input.world_text.clear();
    check_readable(input.world, {FileKind::world});
    s.open_document(input);
    s.edited.document = made;
    s.broadcast_document();
    return json::object();
}

json save_document(Session& s, const Request& r) {
    auto& document = *s.edited.document;
    const auto& file = r.text("file");
    const std::string before = document.path(), to = file.empty() ? before : file;
    if (backup_of(to))
        throw InputError(fmt::format("'{}' is a backup and stays as it is", to),
                         "save it under the name of the system, or under another one");
    std::error_code ignored;
    const bool same = to == before || fs::equivalent(to, before, ignored);
    if (!same)
        check_writable(s, to, FileKind::system, r.flag("overwrite"));
    else if (document.changed_outside())
        check_replaceable(s, to, FileKind::system);
    else
        refuse_shipped(s, to);
    document.save(file, s.run().registry(), r.flag("overwrite"), s.edited.steps.texts_of_system());
    // The file now has a text that does not run.
    if (!s.edited.current && s.edited.input.text.empty()) s.edited.input.text = s.live.begun.text;
    s.edited.input.system = document.path();
    if (s.edited.wanted) s.edited.wanted->system = document.path();
    s.edited.outside = false;
    if (s.edited.current) s.edited.built = document.system();
    note_recent({document.path(), s.edited.input.world, s.edited.input.seed});
    if (s.recovery.files && document.path() != before) s.restart_autosave(), s.recovery.version.reset();
    s.log({.command = "save",
           .title = (to == before ? "save " : "save as ") + fs::path(to).filename().string(),
           .scripts = of_save(s.edited_file(before), to)});
    s.pages.broadcast(s.system_message()), s.broadcast_document();
    return {{"file", document.path()}};
}

json write_backup(Session& s, const Request&) {
    auto path = s.edited.document->path();
    if (const auto backup = backup_of(path)) path = backup->system;
    if (path.empty()) throw InputError("the system has no file yet", "save it first");
    refuse_shipped(s, path);
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    const auto file = backup_path(path, local);
    if (fs::exists(file)) throw InputError(fmt::format("'{}' exists", file), "wait for a second");
    write_file(file, s.edited.document->text());
    return {{"file", file}};
}

json reload_document(Session& s, const Request& r) {
    const auto& keep = r.text("keep");
    const auto before = s.edited.document->text();
    if (keep != "mine") check_readable(s.edited.document->path(), {FileKind::system});
    const bool changed = s.edited.document->reload(keep == "mine"     ? Document::Keep::mine
                                                   : keep == "theirs" ? Document::Keep::theirs
                                                                      : Document::Keep::merge);
    s.edited.outside = false;
    if (changed)
        return follow_edit(s, {.title = keep == "theirs" ? "the text of the file" : "merge with the file",
                               .system = before});
    s.broadcast_document();
    return {{"generation", s.edited.generation}};
}

json import_process_file(Session& s, const Request& r) {
    const auto& path = r.text("file");
    const json operation = {{"do", r.flag("link") ? "use_part" : "import"}, {"file", path}};
    json out = edit_document(s, json::array({operation}), "import " + fs::path(path).filename().string());
    out["id"] = out["ids"][0];
    out.erase("ids"), out.erase("warnings");
    return out;
}

json export_process_file(Session& s, const Request& r) {
    const auto& path = r.text("file");
    if (!s.edited.document->readable())
        throw InputError("the text of the system has mistakes that hide its meaning", "correct them first");
    check_writable(s, path, FileKind::process, r.flag("overwrite"));
    write_file(path,
               xml::write_process(model::extract_process(s.edited.document->system(), r.text("process"))));
    return {{"file", path}};
}

json change_settings(Session& s, const Request& r) {
    if (r.has("save_interval")) {
        write_save_interval(r.number("save_interval"));
        s.recovery.save_interval = r.number("save_interval");
    }
    return {{"save_interval", s.recovery.save_interval}};
}

/// The folder of a file when a page may write there, else the working directory.
fs::path user_folder(const Session& s, const std::string& file) {
    const auto parent = fs::path(file).parent_path();
    const fs::path folder = parent.empty() ? "." : parent;
    return s.comes_with_forage(file) || access(folder.c_str(), W_OK) != 0 ? "." : folder;
}

json list_files(Session& s, const Request& r) {
    const auto& beside = r.text("beside");
    const fs::path here = r.text("folder").empty()
                              ? user_folder(s, beside.empty() ? s.edited.input.system : beside)
                              : fs::path(r.text("folder"));
    std::error_code failed;
    const fs::path where = fs::canonical(here, failed);
    if (failed || !fs::is_directory(where))
        throw InputError(fmt::format("'{}' is not a folder", here.string()));
    std::vector<std::string> folders, files, backups;
    for (const auto& entry : fs::directory_iterator(where, fs::directory_options::skip_permission_denied)) {
        const std::string name = entry.path().filename().string();
        std::error_code ignored;
        if (name.starts_with(".")) continue;
        if (entry.is_directory(ignored))
            folders.push_back(name);
        else if (is_shown(entry.path()))
            files.push_back(name);
        else if (backup_of(name))
            backups.push_back(name);
    }
    std::ranges::sort(folders), std::ranges::sort(files);
    std::ranges::sort(backups, std::greater());  // of each system, the latest first
    json dated = json::array();
    for (const auto& name : backups) {
        const auto backup = backup_of(name);
        dated.push_back({{"file", name}, {"system", backup->system}, {"time", backup->time}});
    }
    return {{"folder", where.string()},
            {"parent", where.parent_path().string()},
            {"folders", folders},
            {"files", files},
            {"backups", std::move(dated)}};
}

json list_recent(Session&, const Request&) {
    const auto use = [](const auto& u) {
        return json{{"file", u.file}, {"world", u.world}, {"seed", u.seed}};
    };
    return {{"files", collected(recent_files(), use)}};
}

}  // namespace

void refuse_shipped(const Session& s, const std::string& path) {
    if (s.comes_with_forage(path))
        throw InputError(fmt::format("'{}' comes with Forage and stays as it is", path),
                         "save it in a folder of your own");
}

std::vector<Command> document_commands() {
    const auto overwrite = optional("overwrite", boolean(), false);
    const std::string file = "{ file: string }";
    return {
        {.name = "document",
         .doc = "Returns the message `document`, the text of the system, at most 4 MB, and the generation.",
         .result = "DocumentMessage & { text: string; generation: number }",
         .apply = read_document},
        {.name = "difference",
         .doc = "Returns the changes since the last save, as `diff -u` prints them.",
         .result = "{ text: string }",
         .apply = [](Session& s, const Request&) -> json {
             return {{"text", s.edited.document->difference()}};
         }},
        {.name = "new",
         .doc = "Opens a system without a file, and without content or with that of a template.",
         .arguments = {{"name", text()},
                       optional("world", path(), ""),
                       optional("from", path(), "", "a template, as `shipped` lists it")},
         .changes_run = true,
         .apply = open_new_system},
        {.name = "backup",
         .doc =
             "Writes the text as it is now into a file beside the system whose name ends with date and time: "
             "`dac.iqr,2026-11-26_05-14-17`. A backup that is open gives another one of the same system.",
         .result = file,
         .apply = write_backup},
        {.name = "save",
         .doc = "Saves the system. Rejected when the file was changed by another program, exists under a new "
                "name, or is a backup.",
         .arguments = {optional("file", path(), "", "by default the same"), overwrite},
         .result = file,
         .apply = save_document},
        {.name = "reload",
         .doc =
             "Follows a file that another program changed. `merge` makes the changes of this document in the "
             "text of the file, unless both have changed the same thing.",
         .arguments = {{"keep", choice({"mine", "theirs", "merge"})}},
         .result = "{ generation: number }",
         .changes_run = true,
         .apply = reload_document},
        {.name = "import",
         .doc = "Adds the process of a file, or a link to the file.",
         .arguments = {{"file", path(), "`.iqrProcess`"}, optional("link", boolean(), false)},
         .result = "{ id: string; generation: number }",
         .changes_run = true,
         .apply = import_process_file},
        {.name = "export",
         .doc = "Writes a process into a file.",
         .arguments = {{"process", text(), "an id"}, {"file", path(), "`.iqrProcess`"}, overwrite},
         .result = file,
         .apply = export_process_file},
        {.name = "recent",
         .doc = "Lists the last systems, at most twenty, from `$XDG_STATE_HOME/forage/recent`, each with the "
                "world and the seed that it had.",
         .result = "{ files: RecentFile[] }",
         .apply = list_recent},
        {.name = "settings",
         .doc = "Changes and returns the settings in `$XDG_STATE_HOME/forage/settings.json`, for the studios "
                "that start from now on.",
         .arguments = {optional("save_interval", number(min_save_interval, max_save_interval), nullptr,
                                "in s")},
         .result = "{ save_interval: number }",
         .apply = change_settings},
        {.name = "files",
         .doc = "Lists systems, worlds and what is beside them, and backups, the latest of a system first.",
         .arguments = {optional(
                           "folder", path(), "",
                           "by default that of `beside` when it may be written, else the working directory"),
                       optional("beside", path(), "", "a file; by default that of the system")},
         .result = "FilesResult",
         .apply = list_files},
    };
}

}  // namespace forage::studio
