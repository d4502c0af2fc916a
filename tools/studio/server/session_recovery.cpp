// What is kept of a session in case its program is killed.
#include <chrono>
#include <exception>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/run/checkpoint_file.h"
#include "tools/api/open/sources.h"
#include "tools/studio/server/recent.h"
#include "tools/studio/server/session.h"

namespace forage::studio {
namespace {

/// The first part of the content of a file.
struct Head {
    std::string version = FORAGE_VERSION, files;
    std::uint64_t cycle = 0;
    double seconds = 0;
    std::int64_t saved = 0;  ///< seconds since 1970
    void checkpoint(Archive& archive) { archive(version, files, cycle, seconds, saved); }
};

/// The systems of all sessions that were killed.
std::set<std::string> systems_of_killed() {
    std::set<std::string> out;
    for (const auto& content : RecoveryFiles::all_killed()) try {
            Archive archive{std::string_view(content)};
            Head head;
            RunInput opened;
            archive(head), archive_input(archive, opened);
            out.insert(std::filesystem::path(opened.system).lexically_normal().string());
        } catch (const ArchiveError&) {  // of another version
        }
    return out;
}

const char* const begin_anew = "begin anew, or close this message";

}  // namespace

json Session::json_of_changes(const Changes& changes) {
    json out = json::object();
    for (const auto& [name, change] : changes) out[name] = {change.assignment, change.loaded};
    return out;
}

Session::Changes Session::changes_of(const json& text) {
    Changes out;
    for (const auto& [name, change] : text.items())
        out[name] = {change.at(0).get<std::string>(), change.at(1)};
    return out;
}

void Session::keep() {
    kept_.emplace(input_.system);
    if (!document_->path().empty()) note_recent(document_->path());
    look_for_killed();
    saved_version_ = version_;  // there is nothing to lose yet
}

void Session::keep_anew() {
    kept_->forget_running();
    try {
        keep();
    } catch (const std::exception& e) {
        kept_.reset();
        save_failed_ = e.what();
    }
}

void Session::look_for_killed() {
    killed_ = nullptr;
    try {
        if (const auto content = kept_->killed()) {
            Archive archive{std::string_view(*content)};
            Head head;
            archive(head);
            killed_ = {{"cycle", head.cycle}, {"seconds", head.seconds}, {"saved", head.saved}};
        }
    } catch (const std::exception& e) {
        save_failed_ = e.what();
        kept_->forget_killed();
    }
    status_due_ = true;
}

void Session::save() {
    try {
        Archive archive;
        Head head;
        head.files = files_, head.cycle = run_->cycle(), head.seconds = run_->seconds();
        head.saved = std::chrono::duration_cast<std::chrono::seconds>(
                         std::chrono::system_clock::now().time_since_epoch())
                         .count();
        RunInput opened = input_, begun = begun_;
        json undo = json::array(), redo = json::array(), compare;
        for (const auto& u : undo_) undo.push_back({u.undo, u.redo, u.title, u.document});
        for (const auto& u : redo_) redo.push_back({u.undo, u.redo, u.title, u.document});
        json world;
        if (world_text_) world = {world_text_->path, world_text_->text, world_text_->saved};
        if (reference_)
            compare = {{"from", reference_->from}, {"changed", json_of_changes(reference_->changed)}};
        std::string rest = json{{"world", world},    {"changed", json_of_changes(changed_)},
                                {"undo", undo},      {"redo", redo},
                                {"panels", panels_}, {"mode", mode_},
                                {"value", value_},   {"compare", compare}}
                               .dump(-1, ' ', false, json::error_handler_t::replace);
        archive(head);
        archive_input(archive, opened), archive_input(archive, begun);
        bool waits = wanted_.has_value();
        RunInput wanted = wanted_.value_or(RunInput());
        archive(rest, *document_, current_, waits);
        if (waits) archive_input(archive, wanted);
        history_.save(archive, run_->cycle());
        if (reference_) reference_->past.save(archive, run_->cycle());
        kept_->write(archive.bytes());
        save_failed_.clear();
    } catch (const std::exception& e) {
        save_failed_ = fmt::format("the session cannot be kept for the case of a crash: {}", e.what());
    }
    saved_version_ = version_;
    status_due_ = true;
}

/// What the file of a killed session holds.
struct Session::Killed {
    RunInput opened, begun;
    std::optional<RunInput> wanted;
    std::uint64_t cycle = 0;
    Document document;
    bool current = true;
    History past;
    std::optional<Reference> reference;
    Changes changed;
    std::vector<Undo> undo, redo;
    std::optional<WorldText> world_text;
    json panels;
    std::string mode;
    double value = 0;
};

Session::Killed Session::read_killed(std::string_view content) {
    Archive archive{content};
    Head head;
    archive(head);
    if (head.version != FORAGE_VERSION)
        throw InputError(fmt::format("the session that was killed is of forage {}, and this is {}",
                                     head.version, FORAGE_VERSION),
                         begin_anew);
    Killed out;
    out.cycle = head.cycle;
    archive_input(archive, out.opened), archive_input(archive, out.begun);
    std::string text;
    bool waits = false;
    archive(text, out.document, out.current, waits);
    if (waits) archive_input(archive, out.wanted.emplace());
    const json rest = json::parse(text);
    out.past.load(archive);
    if (const auto& compare = rest.at("compare"); !compare.is_null()) {
        Reference made;
        made.from = compare.at("from"), made.changed = changes_of(compare.at("changed"));
        made.past.load(archive);
        out.reference = std::move(made);
    }
    out.changed = changes_of(rest.at("changed"));
    for (const auto& u : rest.at("undo")) out.undo.push_back({u.at(0), u.at(1), u.at(2), u.at(3)});
    for (const auto& u : rest.at("redo")) out.redo.push_back({u.at(0), u.at(1), u.at(2), u.at(3)});
    if (const auto& world = rest.at("world"); !world.is_null())
        out.world_text = {world.at(0), world.at(1), world.at(2)};
    out.panels = rest.at("panels");
    out.mode = rest.at("mode"), out.value = rest.at("value");
    Diagnostics diagnostics;
    const Sources sources = read_sources(out.begun, diagnostics);
    throw_errors(diagnostics);
    if (digest_of_files(out.begun, sources) != head.files)
        throw InputError(
            fmt::format("the world or a linked process of '{}' has changed since the session was killed",
                        out.begun.system),
            "restore the files, or begin anew");
    return out;
}

void Session::recover() {
    if (!kept_) throw InputError("nothing is kept of sessions", "the messages at the start say why");
    const auto content = kept_->killed();
    if (!content) {
        const auto others = systems_of_killed();
        throw InputError(fmt::format("no session of '{}' was killed", input_.system),
                         others.empty()
                             ? "begin anew"
                             : fmt::format("there are sessions of '{}'", fmt::join(others, "', '")));
    }
    auto killed = read_killed(*content);
    const RunInput before = wanted_.value_or(input_);
    open(std::move(killed.begun));
    try {
        history_ = std::move(killed.past);
        replay(killed.cycle);
    } catch (...) {  // a course that cannot be taken again leaves the system as it was opened
        open_any(before);
        throw;
    }
    input_ = std::move(killed.opened);
    begin_document(begun_);
    wanted_ = std::move(killed.wanted);
    if (killed.current) built_ = killed.document.system();
    document_ = std::move(killed.document), current_ = killed.current;
    problems_ = document_->problems(run_->registry(), run_->environment());
    if (killed.reference) run_beside(std::move(*killed.reference), killed.cycle);
    changed_ = std::move(killed.changed);
    undo_ = std::move(killed.undo), redo_ = std::move(killed.redo);
    trim_undo();
    world_text_ = std::move(killed.world_text);
    note_opening();
    panels_ = std::move(killed.panels);
    set_speed(killed.mode, killed.value);
    save();
    if (save_failed_.empty()) kept_->forget_killed();
    killed_ = nullptr;
}

void Session::end() {
    close_sampler();
    if (kept_) kept_->forget_running();
}

}  // namespace forage::studio
