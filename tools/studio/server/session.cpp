#include "tools/studio/server/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <forage/forage.h>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/model/refused.h"
#include "tools/api/describe/describe_json.h"
#include "tools/api/edit/json_text.h"
#include "tools/api/open/sources.h"
#include "tools/plot/world_map.h"
#include "tools/studio/server/commands.h"
#include "tools/studio/server/commands/command.h"
#include "tools/studio/server/plot_layout.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

double clock_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds the time until its end to a sum, s.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch() { sum_ += clock_now() - begun_; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& sum_;
    double begun_ = clock_now();
};

/// One cycle of so many is timed, as the clock takes time, too; rows begin and end at even ones.
constexpr std::uint64_t timed_cycle = 61;
constexpr double slice = 0.004;             ///< seconds of cycles between two looks for commands
constexpr double look_interval = 1;         ///< s between two looks at the document's file
constexpr double status_interval = 0.1;     ///< s
constexpr double frame_interval = 1. / 30;  ///< s
constexpr double save_rest = 1;             ///< s between two savings while the run rests
constexpr double most_behind = 0.25;        ///< seconds that a paced run may try to catch up

/// A layout of the studio, or the plots of the original.
json read_layout(const Run& run, const std::string& path) {
    const std::string text = read_file(path);
    if (path.ends_with(".conf")) return plot_layout(run, path, text);
    json out = json::parse(text, nullptr, false);
    if (out.is_discarded())
        throw InputError("'" + path + "' is not a layout of the studio",
                         "its name ends with .layout.json, or with .conf for plots of the original");
    return out;
}

/// The floor and what never moves, exactly on the view of a map.
plot::Picture floor_picture(const bug::World& world) {
    const plot::WorldMap map(world, {}, 1600, 0, 0);
    return {std::floor(map.width()), std::floor(map.height()),
            [map](plot::Canvas& canvas) { map.draw_ground(canvas); }};
}

}  // namespace

Session::Session(const RunInput& input, Send send, const std::string& plot_config, std::string shipped)
    : send_(std::move(send)), shipped_(std::move(shipped)), plot_config_(plot_config) {
    open_any(input);
    note_opening();
    read_plot_config(*run_);
}

void Session::read_plot_config(const Run& run) {
    if (!plot_config_.empty()) layout_ = read_layout(run, plot_config_);
}

std::pair<std::unique_ptr<Run>, Touches*> Session::make_run(const RunInput& input, std::string* files) {
    Diagnostics diagnostics;
    const Sources sources = read_sources(input, diagnostics);
    auto loaded = assemble(sources, input, diagnostics);
    throw_errors(diagnostics);
    auto run = Run::make(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                         {.seed = input.seed}, diagnostics);
    throw_errors(diagnostics);
    auto& touches = run->add(std::make_unique<Touches>());
    run->start();
    run->title = run_title(input);
    if (files) *files = digest_of_files(input, sources);
    return {std::make_unique<Run>(std::move(*run)), &touches};
}

void Session::open(RunInput input) {
    std::string files;
    auto [run, touches] = make_run(input, &files);
    close_sampler();
    end_reference();
    files_ = std::move(files);
    input_ = begun_ = std::move(input);
    // The text as it is now: the file may change while the run goes.
    if (begun_.text.empty() && !begun_.system.ends_with(".iqrProcess"))
        begun_.text = read_file(begun_.system);
    run_ = std::move(run);
    touches_ = touches;
    rebind();  // at once: what follows may fail, and streams must not read the run before
    failed_.clear(), running_ = sampled_ = false, pause_after_trials_.reset();
    history_.begin(*run_);
    rewound();
}

void Session::reset() {
    const auto touched = touches_->groups();
    RunInput input = input_;
    if (input.text.empty()) input.text = begun_.text;  // its file may have changed outside
    set_beside_document(input);
    const RunInput as_opened = input_;
    const std::uint64_t seed = input.seed;
    open(std::move(input));
    input_ = as_opened, input_.seed = seed;
    for (const auto& [group, manipulation] : touched) touches_->put(manipulation.settings());
    history_.begin(*run_);
}

void Session::set_beside_document(RunInput& input) const {
    for (const auto& [name, change] : changed_) {
        Diagnostics not_here;  // what the document has, it says itself
        const auto where = name.substr(0, name.rfind('.'));
        const auto has = [&](const model::System& system) {
            return static_cast<bool>(model::find_item(system, where, "", not_here));
        };
        if (!has(document_->system()) && std::ranges::any_of(others_, has))
            input.settings.push_back({change.assignment});
    }
}

void Session::rebind() {
    sources_.clear();
    for (auto& [id, client] : clients_) client.rebind(*run_, sources_);
}

void Session::rewound() {
    ++epoch_, ++version_;
    pace_from_ = rate_from_ = -1, status_due_ = true;
    for (auto& [id, client] : clients_) client.clear();
}

void Session::connect(int client) {
    clients_[client];
    // A file with mistakes may hold anything, also what is not UTF-8.
    const auto send = [&](const json& message) {
        send_(client, false, message.dump(-1, ' ', false, json::error_handler_t::replace));
    };
    send({{"type", "hello"},
          {"protocol", 1},
          {"version", FORAGE_VERSION},
          {"capabilities",
           {"run", "streams", "parameters", "manipulations", "sampler", "move", "history", "layouts",
            "panels", "pictures", "recovery", "compare", "edit"}},
          {"layout", layout_},
          {"panels", panels_}});
    send(system_message());
    send(world_message());
    send(document_message());
    send(status());
}

void Session::tell(const json& message) {
    const std::string text = message.dump(-1, ' ', false, json::error_handler_t::replace);
    for (const auto& [id, client] : clients_) send_(id, false, text);
}

json Session::system_message() {
    json out = describe_system(shown_system(), run_->registry(), run_.get());
    out["file"] = input_.system, out["opened"] = opened_;
    return out;
}

json Session::world_message() {
    const auto* world = dynamic_cast<const bug::World*>(run_->environment());
    if (!world) return {{"type", "world"}, {"file", nullptr}};
    json out = describe_world(*world);
    out["picture"] = fmt::format("/picture?what=world&format=png&epoch={}&of={}", epoch_, generation_);
    return out;
}

json Session::trials_status() const {
    if (!run_->has_trials()) return nullptr;
    const auto& world = *run_->environment();
    const auto& finished = world.trials(0);
    const auto trial = [&](const Trial& t) {
        json out = {{"number", t.number},
                    {"seconds", static_cast<double>(t.cycles) * run_->seconds_per_cycle()},
                    {"reached_target", t.reached_target},
                    {"smallest_distance", nullptr}};
        if (std::isfinite(t.smallest_distance)) out["smallest_distance"] = t.smallest_distance;
        return out;
    };
    return {{"finished", finished.size()},
            {"reached", std::ranges::count(finished, true, &Trial::reached_target)},
            {"current", trial(world.current_trial(0))},
            {"last", finished.empty() ? json(nullptr) : trial(finished.back())}};
}

json Session::status() const {
    json manipulations = json::array(), sampler = nullptr;
    for (const auto& [group, m] : touches_->groups())
        manipulations.push_back(run_->layout().groups[static_cast<std::size_t>(group)].path);
    if (sampler_) sampler = {{"file", sampler_->what.file}, {"rows", sampler_->rows}};
    const double rate = running_ ? measured_rate_ : 0;
    return {{"type", "status"},
            {"running", running_},
            {"cycle", run_->cycle()},
            {"seconds", run_->seconds()},
            {"seed", run_->seed()},
            {"epoch", epoch_},
            {"speed", {{"mode", mode_}, {"value", value_}}},
            {"cycles_per_second", rate},
            {"times_real_time", rate * run_->seconds_per_cycle()},
            {"pages_share", running_ ? pages_share_ : 0},
            {"generation", generation_},
            {"undo", undo_.empty() ? json(nullptr) : json(undo_.back().title)},
            {"redo", redo_.empty() ? json(nullptr) : json(redo_.back().title)},
            {"divergence", run_->divergence()},
            {"failed", failed_},
            {"sampler", std::move(sampler)},
            {"sampler_waits", sampler_waits_.is_null() ? json(nullptr) : sampler_waits_.at("file")},
            {"manipulations", std::move(manipulations)},
            {"history", {{"first", history_.first()}, {"last", history_.last()}}},
            {"trials", trials_status()},
            {"compare", reference_ ? json{{"from", reference_->from}} : json(nullptr)},
            {"killed", killed_},
            {"save_failed", save_failed_}};
}

void Session::message(int client, std::string_view text) {
    const double begun = clock_now();
    json reply;
    json id = nullptr;
    try {
        const json command = json::parse(text, nullptr, false);
        if (!command.is_object()) {
            reply = {{"ok", false}, {"problems", problem("a message is one JSON object")}};
        } else {
            id = command.value("id", json());
            check_depth(command);
            reply = execute(client, command);
            if (command.value("command", json()) == "ack" && reply["ok"] == true) {
                pages_time_ += clock_now() - begun;
                return;
            }
        }
    } catch (const InputError& e) {
        reply = {{"ok", false}, {"problems", problems_of(e.diagnostics())}};
    } catch (const json::exception& e) {
        reply = {{"ok", false}, {"problems", problem(e.what())}};
    }
    reply["type"] = "reply", reply["id"] = std::move(id);
    send_(client, false, reply.dump(-1, ' ', false, json::error_handler_t::replace));
    if (status_due_ && !running_) tell(status()), status_due_ = false;
}

json Session::execute(int client, const json& command) {
    try {
        return {{"ok", true}, {"result", execute_command(*this, client, command)}};
    } catch (const Conflict& e) {
        return {{"ok", false}, {"conflict", true}, {"problems", problem(e.what())}};
    } catch (const FileExists& e) {
        return {{"ok", false}, {"reason", "file_exists"}, {"problems", problems_of(e.diagnostics())}};
    } catch (const NothingLeft& e) {
        return {{"ok", false}, {"reason", "nothing"}, {"problems", problems_of(e.diagnostics())}};
    } catch (const InputError& e) {
        return {{"ok", false}, {"problems", problems_of(e.diagnostics())}};
    } catch (const model::Refused& e) {
        return {{"ok", false}, {"problems", problem(e.what(), e.hint())}};
    } catch (const json::exception& e) {
        return {{"ok", false}, {"problems", problem(e.what(), "docs/design/studio-protocol.md")}};
    } catch (const std::exception& e) {
        return {{"ok", false}, {"problems", problem(e.what())}};
    }
}

void Session::apply(const json& action) {
    find_command(action.at("command").get<std::string>()).repeat(*this, action);
}

void Session::act(const json& action, const std::optional<json>& undo, json told) {
    repeat_actions();
    apply(action);
    ++generation_, ++version_;
    status_due_ = true;
    const std::string title = told.at("title");
    history_.act(run_->cycle(), action, title);
    if (undo) add_undo({*undo, action, title});
    told["type"] = "action", told["generation"] = generation_, told["cycle"] = run_->cycle();
    told["command"] = action.at("command"), told["undoable"] = undo.has_value();
    tell(told);
}

void Session::repeat_actions() {
    while (const auto* action = history_.due(run_->cycle())) apply(action->command);
}

void Session::cycle() {
    repeat_actions();
    run_->step();
    ++version_;
    history_.after_cycle(*run_);
    if (reference_) step_reference();
    if (pause_after_trials_ && run_->environment()->trials(0).size() >= *pause_after_trials_)
        pause_after_trials_.reset(), running_ = false, status_due_ = true;
    const std::uint64_t done = run_->cycle() - 1;
    if (done % timed_cycle == 0) {
        rows_time_ = 0;
        const Stopwatch watch(rows_time_);
        sources_.after_cycle(done, version_);
    } else {
        sources_.after_cycle(done, version_);
    }
    pages_time_ += rows_time_;
    if (!sampler_) return;
    sampler_->recorder->record(run_->simulation());
    if (done % sampler_->what.every == 0) ++sampler_->rows;
    if (sampler_->left && --*sampler_->left == 0) close_sampler();
}

void Session::close_sampler() {
    if (!sampler_) return;
    sampler_->recorder->close();
    finish(sampler_->what.file);
    auto what = sampler_->what;
    what.until.reset();
    if (sampler_->rows > 0) what.until = run_->cycle() - 1;
    sampler_.reset();
    status_due_ = true;
    tell_action("sample_stop", "end of recording", of_sampling_end(what));
}

void Session::tell_action(const std::string& command, const std::string& title, const Equivalent& forms,
                          const std::vector<std::string>& ended) {
    tell({{"type", "action"},
          {"generation", generation_},
          {"cycle", run_->cycle()},
          {"command", command},
          {"title", title},
          {"shell", forms.shell},
          {"python", forms.python},
          {"undoable", false},
          {"ended", ended}});
}

void Session::go_to(std::uint64_t cycle) {
    running_ = false;
    if (reference_ && (cycle < reference_->from || !failed_.empty())) end_reference();
    if (!failed_.empty() || !history_.ahead(run_->cycle(), cycle)) {
        if (sampler_) throw InputError("a sampler cannot go back", "stop the sampler first");
        if (!failed_.empty()) {  // a run that failed cannot go on, so its past is restored into a new one
            auto past = history_;
            const RunInput input = input_;
            open(input);
            history_ = std::move(past);
        }
        replay(cycle);
        if (reference_) with_reference([&] { replay(cycle); });
        return;
    }
    while (run_->cycle() < cycle) this->cycle();
}

void Session::replay(std::uint64_t cycle) {
    history_.restore(*run_, cycle);
    rewound();
    while (run_->cycle() < cycle) {
        repeat_actions();
        run_->step();
    }
}

void Session::set_speed(const std::string& mode, double value) {
    mode_ = mode, value_ = value;
    pace_from_ = -1, status_due_ = true;
}

double Session::rate() const {
    if (mode_ == "free") return 0;
    if (mode_ == "cycles") return value_;
    return (mode_ == "times" ? value_ : 1) / run_->seconds_per_cycle();
}

double Session::work(double now) {
    if (!clients_.empty() && now - looked_at_ >= look_interval) look_outside(), looked_at_ = now;
    if (running_) {
        const double wanted = rate();
        if (rate_from_ < 0) rate_from_ = now, rate_cycle_ = run_->cycle(), pages_time_ = 0;
        if (pace_from_ < 0) pace_from_ = now, pace_cycle_ = run_->cycle();
        try {
            const double end = clock_now() + slice;
            while (running_) {
                if (wanted > 0) {
                    const double due = pace_from_ + static_cast<double>(run_->cycle() - pace_cycle_) / wanted;
                    if (due > now) break;
                    if (now - due > most_behind) pace_from_ = now, pace_cycle_ = run_->cycle();
                }
                cycle();
                if (clock_now() > end) break;
            }
        } catch (const std::exception& e) {
            running_ = false, failed_ = e.what(), status_due_ = true;
        }
        if (const double passed = now - rate_from_; passed > 0.5) {
            measured_rate_ = static_cast<double>(run_->cycle() - rate_cycle_) / passed;
            pages_share_ = std::min(1., pages_time_ / passed);
            rate_from_ = now, rate_cycle_ = run_->cycle(), pages_time_ = 0;
        }
    }
    if (!clients_.empty() && (status_due_ || running_) && now - status_at_ >= status_interval) {
        const Stopwatch watch(pages_time_);
        tell(status());
        status_at_ = now, status_due_ = false;
    }
    if (kept_ && saved_version_ != version_ &&
        now - saved_at_ >= (running_ ? settings_.save_interval : save_rest))
        save(), saved_at_ = now;
    // All pages get their frames at the same time, so that what several of them watch is drawn once.
    bool waits = false, sent = false;
    const bool due = failed_.empty() && now - frames_at_ >= frame_interval;
    const Stopwatch watch(pages_time_);
    for (auto& [id, client] : clients_) {
        if (due)
            if (auto frame = client.frame(*run_, version_, epoch_))
                send_(id, true, std::move(*frame)), sent = true;
        waits = waits || (failed_.empty() && client.watches() && client.in_flight() < Client::window);
    }
    if (sent) frames_at_ = now;
    if (!running_) {
        if (waits || status_due_) return frame_interval;
        const double idle = clients_.empty() ? std::numeric_limits<double>::infinity() : look_interval;
        return kept_ && saved_version_ != version_ ? std::clamp(saved_at_ + save_rest - now, 0.001, idle)
                                                   : idle;
    }
    const double wanted = rate();
    if (wanted <= 0) return 0;
    const double next = pace_from_ + static_cast<double>(run_->cycle() - pace_cycle_) / wanted;
    return std::clamp(next - clock_now(), 0.0, frame_interval);
}

std::string Session::picture(const std::string& what, const std::string& format) {
    if (what != "world") return draw(*run_, what, format);
    const auto* world = dynamic_cast<const bug::World*>(run_->environment());
    const auto wanted = plot::format_of("x." + format);
    if (!world || !wanted) throw InputError("there is no such picture", "a picture of a world needs a world");
    return plot::render(floor_picture(*world), *wanted);
}

}  // namespace forage::studio
