#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/model/build.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/studio/server/backups.h"
#include "tools/studio/server/command_functions.h"
#include "tools/studio/server/recent.h"
#include "tools/studio/server/settings.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_text = 4u << 20;  ///< bytes of a text that a page edits

/// What a page opens or writes: systems, worlds, and what is beside them.
bool is_shown(const fs::path& file) {
    constexpr std::string_view endings[] = {".iqr",  ".iqrProcess", ".world", ".sdf",  ".xml",
                                            ".conf", ".hconf",      ".pconf", ".json", ".csv",
                                            ".dat",  ".h5",         ".npy",   ".txt"};
    return std::ranges::find(endings, file.extension().string()) != std::end(endings);
}

model::ProcessFile process_file(const std::string& path) {
    Diagnostics diagnostics;
    auto file = xml::read_process(path, diagnostics);
    if (!file) throw InputError(std::move(diagnostics));
    return *std::move(file);
}

/// The ids of a linked process are those of its file, so that they must be free.
void refuse_taken_ids(const model::System& system, const model::ProcessFile& file, const std::string& path) {
    const auto refuse_taken = [&](const std::string& id) {
        const auto has_it = [&](const auto& item) { return item.id == id; };
        const auto in_process = [&](const auto& p) {
            return has_it(p) || std::ranges::any_of(p.groups, has_it);
        };
        if (std::ranges::any_of(system.processes, in_process) ||
            std::ranges::any_of(system.connections, has_it))
            throw InputError(fmt::format("'{}' has the id '{}', which the system has, too", path, id),
                             "import the process instead: it gets ids of its own");
    };
    refuse_taken(file.process.id);
    for (const auto& g : file.process.groups) refuse_taken(g.id);
    for (const auto& connection : file.connections) refuse_taken(connection.id);
}

}  // namespace

json Commands::document_read() {
    s.look_outside();
    json out = s.document_message();
    if (document().text().size() > most_text)
        throw InputError(
            fmt::format("the text has {} MB, too many for a page", document().text().size() >> 20),
            "open the file in an editor; the studio notices when it changes");
    out["text"] = document().text(), out["generation"] = s.generation_;
    out.erase("type");
    return out;
}

json Commands::difference() { return {{"text", document().difference()}}; }

json Commands::new_system() {
    RunInput input = s.input_;
    input.more.clear(), input.settings.clear(), input.robots.clear(), input.replay.clear();
    const Document made = Document::create(c.at("name").get<std::string>());
    input.text = made.text();
    input.system = "untitled.iqr";
    input.world = c.value("world", ""), input.world_text.clear();
    s.open_document(input);
    s.document_ = made;
    s.scripted_.begin(made);
    s.tell_document();
    return json::object();
}

void Commands::refuse_shipped(const std::string& file) const {
    if (s.comes_with_forage(file))
        throw InputError(fmt::format("'{}' comes with Forage and stays as it is", file),
                         "save it in a folder of your own");
}

json Commands::save() {
    const auto file = c.value("file", "");
    if (!file.empty() && fs::path(file).extension() != ".iqr")
        throw InputError(fmt::format("'{}' is not a name of a system", file), "it ends with .iqr");
    const std::string before = document().path(), to = file.empty() ? before : file;
    refuse_shipped(to);
    if (backup_of(to))
        throw InputError(fmt::format("'{}' is a backup and stays as it is", to),
                         "save it under the name of the system, or under another one");
    ScriptedSystem scripted = s.scripted_;
    const auto forms = scripted.save(s.edited_file(before), document(), to, run().registry());
    document().save(file, run().registry(), c.value("overwrite", false));
    scripted.note_saved(document());
    s.scripted_ = std::move(scripted);
    // The file now has a text that does not run.
    if (!s.current_ && s.input_.text.empty()) s.input_.text = s.begun_.text;
    s.input_.system = document().path();
    if (s.wanted_) s.wanted_->system = document().path();
    s.outside_ = false;
    if (s.current_) s.built_ = document().system();
    note_recent(document().path());
    if (s.kept_ && document().path() != before) s.keep_anew(), s.saved_version_.reset();
    s.tell_action("save", (to == before ? "save " : "save as ") + fs::path(to).filename().string(), forms);
    s.tell(s.system_message()), s.tell_document();
    return {{"file", document().path()}};
}

json Commands::backup() {
    auto path = document().path();
    if (const auto backup = backup_of(path)) path = backup->system;
    if (path.empty()) throw InputError("the system has no file yet", "save it first");
    refuse_shipped(path);
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    const auto file = backup_path(path, local);
    if (fs::exists(file)) throw InputError(fmt::format("'{}' exists", file), "wait for a second");
    write_file(file, document().text());
    return {{"file", file}};
}

json Commands::reload() {
    const auto keep = c.at("keep").get<std::string>();
    if (keep != "mine" && keep != "theirs" && keep != "merge")
        throw InputError(fmt::format("'{}' cannot be kept", keep), "mine, theirs or merge");
    const bool step = document().reload(keep == "mine"     ? Document::Keep::mine
                                        : keep == "theirs" ? Document::Keep::theirs
                                                           : Document::Keep::merge);
    s.outside_ = false;
    if (step) return edited(keep == "theirs" ? "the text of the file" : "merge with the file");
    s.tell_document();
    return {{"generation", s.generation_}};
}

json Commands::import_process() {
    const auto path = c.at("file").get<std::string>();
    auto file = process_file(path);
    const std::string title = "import " + fs::path(path).filename().string();
    if (c.value("link", false)) refuse_taken_ids(document().system(), file, path);
    std::string made;
    const std::string before = document().text();
    document().edit(
        [&](model::System& system) {
            if (!c.value("link", false)) {
                made = model::import_process(system, std::move(file));
                return;
            }
            // A link is an empty process whose content is in the file.
            made = model::add_process(system, file.process.name);
            auto& process = *model::find_process(system, made);
            const auto& own = document().path();  // empty before the first save
            process.path =
                own.empty()
                    ? fs::absolute(path).string()
                    : fs::relative(fs::absolute(path), fs::absolute(own).parent_path()).generic_string();
        },
        title);
    for (const auto& p : document().system().processes)  // it has the id of its file
        if (p.linked() && p.placeholder.front().id == made) {
            made = p.id;
            break;
        }
    const json operation = {{"do", "import"}, {"file", path}};
    json out = edited(title, before, c.value("link", false) ? json::array() : json::array({operation}));
    out["id"] = made;
    return out;
}

json Commands::export_process() {
    const auto path = c.at("file").get<std::string>();
    if (fs::path(path).extension() != ".iqrProcess")
        throw InputError(fmt::format("'{}' is not a name of a process", path), "it ends with .iqrProcess");
    if (!document().readable())
        throw InputError("the text of the system has mistakes that hide its meaning", "correct them first");
    check_free(path);
    write_file(path, xml::write_process(
                         model::extract_process(document().system(), c.at("process").get<std::string>())));
    return {{"file", path}};
}

json Commands::recent() { return {{"files", recent_files()}}; }

json Commands::settings() {
    if (const auto interval = c.find("save_interval"); interval != c.end()) {
        Settings next = s.settings_;
        next.save_interval = interval->get<double>();
        write_settings(next);
        s.settings_ = next;
    }
    return {{"save_interval", s.settings_.save_interval}};
}

json Commands::files() {
    const auto wanted = c.value("folder", "");
    const fs::path here = wanted.empty() ? folder() : fs::path(wanted);
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

}  // namespace forage::studio
