// What is kept of a session in case its program is killed.
#include <chrono>
#include <exception>

#include <fmt/format.h>

#include "core/run/checkpoint_file.h"
#include "tools/api/sources.h"
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

const char* const begin_anew = "begin anew, or close this message";

}  // namespace

void Session::keep() {
    kept_.emplace(input_.system);
    look_for_killed();
    saved_version_ = version_;  // there is nothing to lose yet
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
        json changed = json::object();
        for (const auto& [name, change] : changed_) changed[name] = {change.assignment, change.loaded};
        json text = nullptr;  // of a system that has not been saved
        if (document_->dirty()) text = document_->text();
        std::string rest = json{
            {"changed", changed},
            {"document", text},
            {"panels", panels_},
            {"mode", mode_},
            {"value", value_}}.dump(-1, ' ', false, json::error_handler_t::replace);
        archive(head);
        archive_input(archive, opened), archive_input(archive, begun);
        archive(rest);
        history_.save(archive, run_->cycle());
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
    if (!content) throw InputError("there is no session that was killed", "begin anew");
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
    archive(text);
    const json rest = json::parse(text);
    History past;
    past.load(archive);
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
    begin_document(input_);
    if (const auto& unsaved = rest.at("document"); unsaved.is_string())
        document_->replace_text(unsaved.get<std::string>(), "before the crash");
    current_ = built_ == document_->system();
    history_ = std::move(past);
    replay(head.cycle);
    changed_.clear();
    for (const auto& [name, change] : rest.at("changed").items())
        changed_[name] = {change.at(0).get<std::string>(), change.at(1)};
    panels_ = rest.at("panels");
    set_speed(rest.at("mode").get<std::string>(), rest.at("value").get<double>());
    rebind();
    save();
    if (save_failed_.empty()) kept_->forget_killed();
    killed_ = nullptr;
}

void Session::end() {
    close_sampler();
    if (kept_) kept_->forget_running();
}

}  // namespace forage::studio
