// What is kept of a session in case its program is killed.
#include <chrono>
#include <exception>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/run/checkpoint_file.h"
#include "tools/api/sources.h"
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
    Archive archive{std::string_view(*content)};
    Head head;
    archive(head);
    if (head.version != FORAGE_VERSION)
        throw InputError(fmt::format("the session that was killed is of forage {}, and this is {}",
                                     head.version, FORAGE_VERSION),
                         begin_anew);
    RunInput opened, begun;
    archive_input(archive, opened), archive_input(archive, begun);
    std::string text;
    Document document;
    bool current = true, waits = false;
    archive(text, document, current, waits);
    RunInput wanted;
    if (waits) archive_input(archive, wanted);
    const json rest = json::parse(text);
    History past;
    past.load(archive);
    const json compare = rest.value("compare", json());
    std::optional<Reference> reference;
    if (!compare.is_null()) {
        Reference made;
        made.from = compare.at("from"), made.changed = changes_of(compare.at("changed"));
        made.past.load(archive);
        reference = std::move(made);
    }
    Diagnostics diagnostics;
    const Sources sources = read_sources(begun, diagnostics);
    throw_errors(diagnostics);
    if (digest_of_files(begun, sources) != head.files)
        throw InputError(
            fmt::format("the world or a linked process of '{}' has changed since the session was killed",
                        begun.system),
            "restore the files, or begin anew");
    open(std::move(begun));
    input_ = std::move(opened);
    history_ = std::move(past);
    replay(head.cycle);
    begin_document(begun_);
    wanted_ = waits ? std::optional(std::move(wanted)) : std::nullopt;
    if (current) built_ = document.system();
    document_ = std::move(document), current_ = current;
    problems_ = document_->problems(run_->registry(), run_->environment());
    if (reference) run_beside(std::move(*reference), head.cycle);
    changed_ = changes_of(rest.at("changed"));
    undo_.clear(), redo_.clear();
    for (const auto& u : rest.at("undo")) undo_.push_back({u.at(0), u.at(1), u.at(2), u.at(3)});
    for (const auto& u : rest.at("redo")) redo_.push_back({u.at(0), u.at(1), u.at(2), u.at(3)});
    trim_undo();
    if (const auto& world = rest.at("world"); !world.is_null())
        world_text_ = {world.at(0), world.at(1), world.at(2)};
    panels_ = rest.at("panels");
    set_speed(rest.at("mode").get<std::string>(), rest.at("value").get<double>());
    save();
    if (save_failed_.empty()) kept_->forget_killed();
    killed_ = nullptr;
}

void Session::end() {
    close_sampler();
    if (kept_) kept_->forget_running();
}

}  // namespace forage::studio
