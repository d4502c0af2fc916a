// What is kept of a session in case its program is killed.
#include <chrono>
#include <exception>
#include <filesystem>
#include <set>

#include <fmt/format.h>

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

const char* const start_again = "start again, or close this message";

json json_of(const Changes& changes) {
    json out = json::object();
    for (const auto& [name, change] : changes) out[name] = {change.assignment, change.loaded};
    return out;
}

Changes changes_of(const json& text) {
    Changes out;
    for (const auto& [name, change] : text.items())
        out[name] = {change.at(0).get<std::string>(), change.at(1)};
    return out;
}

}  // namespace

void Session::keep() {
    recovery.files.emplace(edited.input.system);
    note_use();
    look_for_killed();
    recovery.version = live.version;  // there is nothing to lose yet
}

void Session::save_changes() {
    if (recovery.files && recovery.version != live.version) save();
}

void Session::note_use() const {
    if (recovery.files && !edited.document->path().empty())
        note_recent({edited.document->path(), edited.input.world, edited.input.seed});
}

void Session::restart_autosave() {
    recovery.files->forget_running();
    try {
        keep();
    } catch (const std::exception& e) {
        recovery.files.reset();
        recovery.failed = e.what();
    }
}

void Session::look_for_killed() {
    recovery.killed = nullptr;
    try {
        if (const auto content = recovery.files->killed()) {
            Archive archive{std::string_view(*content)};
            Head head;
            archive(head);
            recovery.killed = {{"cycle", head.cycle}, {"seconds", head.seconds}, {"saved", head.saved}};
        }
    } catch (const std::exception& e) {
        recovery.failed = e.what();
        recovery.files->forget_killed();
    }
    pages.status_due = true;
}

void Session::save() {
    try {
        std::string content;
        content.reserve(recovery.length + recovery.length / 16);
        Archive archive([&](std::string_view bytes) { content += bytes; });
        Head head;
        head.files = live.files, head.cycle = live.run->cycle(), head.seconds = live.run->seconds();
        head.saved = std::chrono::duration_cast<std::chrono::seconds>(
                         std::chrono::system_clock::now().time_since_epoch())
                         .count();
        RunInput opened = edited.input, begun = live.begun;
        json compare;
        json world;
        if (edited.world_text)
            world = {edited.world_text->path, edited.world_text->text, edited.world_text->saved};
        if (live.reference)
            compare = {{"from", live.reference->from}, {"changed", json_of(live.reference->changed)}};
        std::string rest =
            json{{"world", world},           {"changed", json_of(live.changed)}, {"panels", pages.panels},
                 {"mode", live.pace.mode()}, {"value", live.pace.value()},       {"compare", compare}}
                .dump(-1, ' ', false, json::error_handler_t::replace);
        archive(head);
        archive_input(archive, opened), archive_input(archive, begun);
        bool waits = edited.wanted.has_value();
        RunInput wanted = edited.wanted.value_or(RunInput());
        archive(rest, *edited.document, edited.steps, edited.current, waits);
        if (waits) archive_input(archive, wanted);
        live.history.save(archive, live.run->cycle());
        if (live.reference) live.reference->history.save(archive, live.run->cycle());
        recovery.files->write(content);
        recovery.length = content.size();
        recovery.failed.clear();
    } catch (const std::exception& e) {
        recovery.failed = fmt::format("the session cannot be kept for the case of a crash: {}", e.what());
    }
    recovery.version = live.version;
    pages.status_due = true;
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
    UndoSteps steps;
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
                         start_again);
    Killed out;
    out.cycle = head.cycle;
    archive_input(archive, out.opened), archive_input(archive, out.begun);
    std::string text;
    bool waits = false;
    archive(text, out.document, out.steps, out.current, waits);
    if (waits) archive_input(archive, out.wanted.emplace());
    const json rest = json::parse(text);
    out.past.load(archive);
    if (const auto& compare = rest.at("compare"); !compare.is_null()) {
        Reference made;
        made.from = compare.at("from"), made.changed = changes_of(compare.at("changed"));
        made.history.load(archive);
        out.reference = std::move(made);
    }
    out.changed = changes_of(rest.at("changed"));
    if (const auto& world = rest.at("world"); !world.is_null())
        out.world_text = {world.at(0), world.at(1), world.at(2)};
    out.panels = rest.at("panels");
    out.mode = rest.at("mode"), out.value = rest.at("value");
    Diagnostics diagnostics;
    const Sources sources = checked(diagnostics, read_sources(out.begun, diagnostics));
    if (digest_of_files(out.begun, sources) != head.files)
        throw InputError(
            fmt::format("the world or a linked process of '{}' has changed since the session was killed",
                        out.begun.system),
            "restore the files, or start again");
    return out;
}

void Session::recover() {
    if (!recovery.files) throw InputError("nothing is kept of sessions", "the messages at the start say why");
    const auto content = recovery.files->killed();
    if (!content) {
        const auto others = systems_of_killed();
        throw InputError(fmt::format("no session of '{}' was killed", edited.input.system),
                         others.empty()
                             ? "start again"
                             : fmt::format("there are sessions of '{}'", fmt::join(others, "', '")));
    }
    auto killed = read_killed(*content);
    const RunInput before = edited.wanted.value_or(edited.input);
    open(std::move(killed.begun));
    try {
        live.history = std::move(killed.past);
        replay(killed.cycle);
    } catch (...) {  // a course that cannot be taken again leaves the system as it was opened
        open_any(before);
        throw;
    }
    edited.input = std::move(killed.opened);
    begin_document(live.begun);
    edited.wanted = std::move(killed.wanted);
    if (killed.current) edited.built = killed.document.system();
    edited.document = std::move(killed.document), edited.current = killed.current;
    edited.problems = find_problems();
    if (killed.reference) run_beside(std::move(*killed.reference), killed.cycle);
    live.changed = std::move(killed.changed);
    edited.steps = std::move(killed.steps);
    edited.world_text = std::move(killed.world_text);
    note_opening();
    pages.panels = std::move(killed.panels);
    set_speed(killed.mode, killed.value);
    save();
    if (recovery.failed.empty()) recovery.files->forget_killed();
    recovery.killed = nullptr;
}

void Session::end() {
    const auto failed = close_sampler();
    if (recovery.files) recovery.files->forget_running();
    if (!failed.empty()) throw std::runtime_error(failed);
}

}  // namespace forage::studio
