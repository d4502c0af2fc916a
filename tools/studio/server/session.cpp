#include "tools/studio/server/session.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <forage/forage.h>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/model/refused.h"
#include "core/observe/hdf5_file.h"
#include "tools/api/describe/describe_json.h"
#include "tools/api/edit/json_text.h"
#include "tools/plot/world_map.h"
#include "tools/studio/server/commands.h"
#include "tools/studio/server/commands/command.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/plot_layout.h"
#include "tools/studio/server/problems.h"
#include "tools/studio/server/requests.h"

namespace forage::studio {
namespace {

/// Every 61st cycle is timed, because reading the clock takes time. The number is a prime, so timed cycles
/// fall on all positions of a row that joins cycles.
constexpr std::uint64_t timed_cycle = 61;
constexpr double slice = 0.004;             ///< seconds of cycles between two looks for commands
constexpr double look_interval = 1;         ///< s between two looks at the document's file
constexpr double status_interval = 0.1;     ///< s
constexpr double frame_interval = 1. / 30;  ///< s
constexpr double save_rest = 1;             ///< s between two savings while the run rests

/// A layout of the studio, or the plots of the original.
json read_layout(const Run& run, const std::string& path) {
    const std::string text = read_file(path);
    if (path.ends_with(".conf")) return plot_layout(run, path, text);
    check_depth(size_of_json(text));
    json out = json::parse(text, nullptr, false);
    if (out.is_discarded())
        throw InputError("'" + path + "' is not a layout of the studio",
                         "its name ends with .layout.json, or with .conf for plots of the original");
    return out;
}

/// The floors, with what never moves or without it, exactly on the view of a map.
plot::Picture ground_picture(const bug::World& world, bool solids) {
    const auto map = plot::WorldMap::with_floors(world, 1600);
    return {std::floor(map.width()), std::floor(map.height()), [map, solids](plot::Canvas& canvas) {
                solids ? map.draw_ground(canvas) : map.draw_floors(canvas);
            }};
}

}  // namespace

Session::Session(const RunInput& input, Send send, const std::string& plot_config, std::string shipped)
    : pages{.send = std::move(send)}, shipped_(std::move(shipped)), plot_config_(plot_config) {
    open_any(input);
    note_opening();
    read_plot_config(*live.run);
}

void Session::read_plot_config(const Run& run) {
    if (!plot_config_.empty()) pages.layout = read_layout(run, plot_config_);
}

void Session::open(RunInput input) {
    std::string files;
    Course built = open_run(input, &files);
    RunInput begun = input;
    // The text is kept, because the file may change during the run.
    if (begun.text.empty() && !begun.system.ends_with(".iqrProcess")) begun.text = read_file(begun.system);
    close_sampler();
    end_reference();
    live.files = std::move(files);
    live.begun = std::move(begun), edited.input = std::move(input);
    live.take_run(std::move(built));
    pages.rebind(*live.run);  // at once: what follows may fail, and streams must not read the run before
    live.failed.clear(), live.pace.running = live.sampled = false, live.pause_when.reset();
    live.history.begin(*live.run);
    rewound();
}

void Session::reset() {
    const auto touched = live.manipulations->groups();
    RunInput input = edited.input;
    if (input.text.empty()) input.text = live.begun.text;  // its file may have changed outside
    set_beside_document(input);
    const RunInput as_opened = edited.input;
    const std::uint64_t seed = input.seed;
    open(std::move(input));
    edited.input = as_opened, edited.input.seed = seed;
    for (const auto& [group, manipulation] : touched) live.manipulations->put(manipulation.settings());
    live.history.begin(*live.run);
}

void Session::set_beside_document(RunInput& input) const {
    for (const auto& [name, change] : live.changed) {
        Diagnostics not_here;  // what the document has, it says itself
        const auto where = name.substr(0, name.rfind('.'));
        const auto has = [&](const model::System& system) {
            return static_cast<bool>(model::find_item(system, where, "", not_here));
        };
        if (!has(edited.document->system()) && std::ranges::any_of(edited.others, has))
            input.settings.push_back({change.assignment});
    }
}

void Session::rewound() {
    ++live.epoch, ++live.version;
    live.pace.restart(), pages.status_due = true;
    pages.clear();
}

void Session::connect(int client) {
    pages.clients[client];
    json capabilities = json::array();
    if (quit) capabilities.push_back("quit");
    if (observe::has_hdf5()) capabilities.push_back("hdf5");
    const auto send = [&](const json& message) { pages.send(client, false, Pages::text(message)); };
    send({{"type", "hello"},
          {"protocol", 1},
          {"version", FORAGE_VERSION},
          {"capabilities", capabilities},
          {"layout", pages.layout},
          {"panels", pages.panels}});
    send(system_message());
    send(world_message());
    send(document_message());
    send(status());
}

json Session::system_message() {
    json out = describe_system(shown_system(), live.run->registry(), live.run.get());
    out["file"] = edited.input.system, out["opened"] = edited.opened;
    return out;
}

json Session::world_message() {
    const auto* world = dynamic_cast<const bug::World*>(live.run->environment());
    if (!world) return {{"type", "world"}, {"file", nullptr}};
    json out = describe_world(*world);
    const auto version = fmt::format("{}-{}", live.epoch, edited.generation);
    for (const auto& [member, what] : {std::pair("picture", "world"), std::pair("floor", "floor")})
        out[member] = picture_address ? picture_address(what, version) : "";
    return out;
}

const HitCounts& Session::hits() const {
    auto& [counts, run, epoch] = live.counted_hits;
    if (run != live.run.get() || epoch != live.epoch)
        counts.clear(), run = live.run.get(), epoch = live.epoch;
    const auto& finished = live.run->environment()->trials(0);
    for (std::size_t i = counts.size(); i < finished.size(); ++i) counts.add(finished[i].reached_target);
    return counts;
}

json Session::trials_status() const {
    if (!live.run->has_trials()) return nullptr;
    const auto& world = *live.run->environment();
    const auto& finished = world.trials(0);
    const auto trial = [&](const Trial& t) { return describe_trial(t, live.run->seconds_per_cycle()); };
    return {{"finished", finished.size()},
            {"reached", hits().among(0, finished.size())},
            {"current", trial(world.current_trial(0))},
            {"last", finished.empty() ? json(nullptr) : trial(finished.back())}};
}

json Session::status() const {
    json manipulations = json::array(), sampler = nullptr;
    for (const auto& [group, m] : live.manipulations->groups())
        manipulations.push_back(live.run->layout().groups[static_cast<std::size_t>(group)].path);
    if (live.sampler) sampler = {{"file", live.sampler->what.file}, {"rows", live.sampler->rows}};
    const double rate = live.pace.running ? live.pace.measured_rate() : 0;
    return {{"type", "status"},
            {"running", live.pace.running},
            {"cycle", live.run->cycle()},
            {"seconds", live.run->seconds()},
            {"seed", live.run->seed()},
            {"epoch", live.epoch},
            {"speed", {{"mode", live.pace.mode()}, {"value", live.pace.value()}}},
            {"cycles_per_second", rate},
            {"times_real_time", rate * live.run->seconds_per_cycle()},
            {"pages_share", live.pace.running ? live.pace.pages_share() : 0},
            {"generation", edited.generation},
            {"undo", UndoSteps::title(edited.steps.undo)},
            {"redo", UndoSteps::title(edited.steps.redo)},
            {"divergence", live.run->divergence()},
            {"failed", live.failed},
            {"sampler", std::move(sampler)},
            {"sampler_waits", live.waiting_sampler ? json(live.waiting_sampler->file) : json(nullptr)},
            {"manipulations", std::move(manipulations)},
            {"history", {{"first", live.history.first()}, {"last", live.history.last()}}},
            {"trials", trials_status()},
            {"compare", live.reference ? json{{"from", live.reference->from}} : json(nullptr)},
            {"killed", recovery.killed},
            {"save_failed", recovery.failed}};
}

void Session::message(int client, std::string_view text) {
    const double begun = clock_now();
    if (auto refused = refusal_of(text)) return pages.send(client, false, std::move(*refused));
    json reply;
    json id = nullptr;
    const json command = json::parse(text, nullptr, false);
    if (!command.is_object()) {
        reply = {{"ok", false}, {"problems", problem("a message is one JSON object")}};
    } else if (const auto given = command.find("id");
               given != command.end() && !given->is_null() && !given->is_number_integer()) {
        reply = {{"ok", false}, {"problems", problem("'id' is not a whole number")}};
    } else {
        if (given != command.end()) id = *given;
        reply = execute(client, command);
        if (command.value("command", json()) == "ack" && reply["ok"] == true) {
            live.pace.pages_time += clock_now() - begun;
            return;
        }
    }
    reply["type"] = "reply", reply["id"] = std::move(id);
    pages.send(client, false, Pages::text(reply));
    if (pages.status_due && !live.pace.running) pages.broadcast(status()), pages.status_due = false;
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

void Session::act(const json& action, LoggedAction logged) {
    live.repeat_actions();
    const auto& command = find_command(action.at("command").get_ref<const std::string&>());
    logged.command = command.name;
    logged.scripts = command.script(*this, action) + logged.scripts;
    command.repeat(live, action);
    ++edited.generation, ++live.version;
    live.history.act(live.run->cycle(), action, logged.title);
    log(logged);
}

void Session::log(const LoggedAction& action) {
    json message = {{"type", "action"},
                    {"generation", edited.generation},
                    {"cycle", live.run->cycle()},
                    {"command", action.command},
                    {"title", action.title},
                    {"shell", action.scripts.shell},
                    {"python", action.scripts.python},
                    {"ended", action.ended}};
    if (!action.item.empty()) message["item"] = action.item;
    if (!action.values.is_null()) message["values"] = action.values;
    if (!action.failed.empty()) message["failed"] = action.failed;
    pages.status_due = true;
    pages.broadcast(message);
}

void Session::compute(const std::function<void()>& cycles) {
    try {
        cycles();
    } catch (const std::exception& e) {
        live.pace.running = false, live.failed = e.what(), pages.status_due = true;
        throw;
    }
}

void Session::cycle() {
    compute([this] {
        live.step();
        ++live.version;
        compute_beside([](Course& course) { course.step(); });
        if (live.pause_when && live.pause_when->condition.reached(*live.run, live.pause_when->since))
            live.pause_when.reset(), live.pace.running = false, pages.status_due = true;
        feed_streams();
    });
    record_cycle();
}

void Session::feed_streams() {
    const std::uint64_t done = live.run->cycle() - 1;
    if (done % timed_cycle == 0) {
        rows_time_ = 0;
        const Stopwatch watch(rows_time_);
        pages.sources.after_cycle(done, live.version);
    } else {
        pages.sources.after_cycle(done, live.version);
    }
    live.pace.pages_time += rows_time_;
}

void Session::record_cycle() {
    if (!live.sampler) return;
    try {
        live.sampler->recorder->record(live.run->simulation());
    } catch (const std::exception& e) {
        close_sampler(e.what());
        return;
    }
    if ((live.run->cycle() - 1) % live.sampler->what.every == 0) ++live.sampler->rows;
    if (live.sampler->left && --*live.sampler->left == 0) close_sampler();
}

std::string Session::close_sampler(std::string failed) {
    if (!live.sampler) return {};
    auto sampler = *std::exchange(live.sampler, std::nullopt);
    auto& what = sampler.what;
    pages.status_due = true;
    try {
        sampler.recorder->close();
        finish(what.file);
    } catch (const std::exception& e) {
        if (failed.empty()) failed = e.what();
    }
    what.until.reset();
    if (sampler.rows > 0) what.until = live.run->cycle() - 1;
    if (!failed.empty()) failed = fmt::format("the recording into '{}' has failed: {}", what.file, failed);
    log({.command = "sample_stop",
         .title = "end of recording",
         .scripts = of_sampling_end(what),
         .failed = failed});
    return failed;
}

void Session::go_to(std::uint64_t cycle) {
    const bool back = !live.failed.empty() || !live.history.ahead(live.run->cycle(), cycle);
    if (back && live.sampler) throw InputError("a sampler cannot go back", "stop the sampler first");
    live.pace.running = false;
    if (live.reference && (cycle < live.reference->from || !live.failed.empty())) end_reference();
    if (back) {
        if (!live.failed
                 .empty()) {  // a run that failed cannot continue, so its past is restored into a new one
            auto past = live.history;
            const RunInput input = edited.input;
            open(input);
            live.history = std::move(past);
        }
        replay(cycle);
        compute_beside([&](Course& course) { course.replay(cycle); });
        return;
    }
    while (live.run->cycle() < cycle) this->cycle();
}

void Session::replay(std::uint64_t cycle) {
    rewound();
    compute([&] { live.replay(cycle); });
}

void Session::set_speed(const std::string& mode, double value) {
    live.pace.set(mode, value);
    pages.status_due = true;
}

double Session::work(double now) {
    if (!pages.clients.empty() && now - edited.outside_checked_at >= look_interval)
        check_file_on_disk(), edited.outside_checked_at = now;
    auto& pace = live.pace;
    const double rate = pace.rate(live.run->seconds_per_cycle());
    if (live.pace.running) {
        pace.begin(now, live.run->cycle());
        try {
            const double end = clock_now() + slice;
            while (live.pace.running && pace.is_due(now, live.run->cycle(), rate)) {
                cycle();
                if (clock_now() > end) break;
            }
        } catch (const std::exception&) {  // cycle() has noted it
        }
        pace.measure(now, live.run->cycle());
    }
    if (!pages.clients.empty() && (pages.status_due || live.pace.running) &&
        now - pages.status_at >= status_interval) {
        const Stopwatch watch(pace.pages_time);
        pages.broadcast(status());
        pages.status_at = now, pages.status_due = false;
    }
    if (recovery.files && recovery.version != live.version &&
        now - recovery.saved_at >= (live.pace.running ? recovery.save_interval : save_rest))
        save(), recovery.saved_at = now;
    // All pages get their frames at the same time, so that what several of them watch is drawn once.
    bool waits = false, sent = false;
    const bool due = live.failed.empty() && now - pages.frames_at >= frame_interval;
    const Stopwatch watch(pace.pages_time);
    for (auto& [id, client] : pages.clients) {
        if (due)
            if (auto frame = client.frame(*live.run, live.version, live.epoch))
                pages.send(id, true, std::move(*frame)), sent = true;
        waits = waits || (live.failed.empty() && client.watches() && client.in_flight() < Client::window);
    }
    if (sent) pages.frames_at = now;
    if (!live.pace.running) {
        if (waits || pages.status_due) return frame_interval;
        const double idle = pages.clients.empty() ? std::numeric_limits<double>::infinity() : look_interval;
        return recovery.files && recovery.version != live.version
                   ? std::clamp(recovery.saved_at + save_rest - now, 0.001, idle)
                   : idle;
    }
    if (rate <= 0) return 0;
    return std::clamp(pace.due(live.run->cycle(), rate) - clock_now(), 0.0, frame_interval);
}

std::string Session::picture(const std::string& what, const std::string& format) {
    if (what != "world" && what != "floor") return draw(*live.run, what, format);
    const auto* world = dynamic_cast<const bug::World*>(live.run->environment());
    const auto wanted = plot::format_of("x." + format);
    if (!world || !wanted) throw InputError("there is no such picture", "a picture of a world needs a world");
    return plot::render(ground_picture(*world, what == "world"), *wanted);
}

}  // namespace forage::studio
