#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/run/explain.h"
#include "tools/api/edit/part_operations.h"
#include "tools/api/open/sources.h"
#include "tools/plot/figure.h"
#include "tools/plot/structure.h"
#include "tools/plot/world_map.h"
#include "tools/studio/server/base64.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/recent.h"

namespace forage::studio {
namespace {

void check_running(const Session& s) {
    if (!s.live.failed.empty())
        throw InputError("the run has failed: " + s.live.failed, "stop it, or go back");
}

json start_run(Session& s, const Request&) {
    check_running(s);
    begin_waiting_sampler(s);
    s.live.pace.running = s.pages.status_due = true, s.live.pause_when.reset();
    s.live.pace.start();
    std::set<int> touched;
    for (const auto& [group, manipulation] : s.live.manipulations->groups()) touched.insert(group);
    json undriven = json::array(), robots = json::array();
    const auto& layout = s.run().layout();
    for (const auto& [group, text] : undriven_inputs(s.run().system(), layout, touched))
        undriven.push_back({{"group", layout.groups[static_cast<std::size_t>(group)].id}, {"text", text}});
    for (const auto& [robot, text] : undriven_robots(s.run()))
        robots.push_back({{"robot", robot}, {"text", text}});
    return {{"undriven", std::move(undriven)}, {"undriven_robots", std::move(robots)}};
}

json run_until(Session& s, const Request& r) {
    RunLength length;
    length.in_code = true, length.until = {r.text("condition")};
    if (r.has("trials")) length.trials = r.whole("trials");
    if (r.has("seconds")) length.seconds = r.number("seconds");
    if (!length.trials && !length.seconds && length.until.empty())
        throw InputError("what should the run wait for?", "a number of trials, seconds, or a condition");
    Diagnostics diagnostics;
    auto condition = checked(diagnostics, StopCondition::make(length, s.run(), diagnostics));
    if (condition.holds(s.run()))
        throw InputError(fmt::format("'{}' holds already", length.until.text),
                         "go back, or wait for something else");
    json started = start_run(s, r);
    s.live.pause_when = {length, std::move(condition), StopCondition::begin(s.run())};
    std::string title = "run";
    if (length.trials) title += fmt::format(" {} trials", *length.trials);
    if (length.seconds) title += fmt::format(" {} s", *length.seconds);
    if (!length.until.empty())
        title += fmt::format("{} until {}", length.trials || length.seconds ? " or" : "", length.until.text);
    RunLength from_start = length;
    if (length.trials) from_start.trials = *length.trials + s.live.pause_when->since.trials;
    if (length.seconds) from_start.seconds = *length.seconds + s.run().seconds();
    s.log({.command = "run_until", .title = title, .scripts = of_run(length, from_start)});
    return started;
}

json condition_holds(Session& s, const Request& r) {
    RunLength length;
    length.in_code = true, length.until = {r.text("condition")};
    Diagnostics diagnostics;
    const auto condition = checked(diagnostics, StopCondition::make(length, s.run(), diagnostics));
    return {{"holds", condition.holds(s.run())}};
}

json pause_run(Session& s, const Request&) {
    s.live.pause_when.reset();
    s.live.pace.running = false, s.pages.status_due = true;
    return json::object();
}

json step_run(Session& s, const Request& r) {
    check_running(s);
    begin_waiting_sampler(s);
    pause_run(s, r);
    for (std::uint64_t i = 0; i < r.whole("cycles"); ++i) s.cycle();
    return {{"cycle", s.run().cycle()}};
}

json stop_run(Session& s, const Request&) {
    const json before = s.system_message();
    s.reset();
    // A module that was switched on or off says now what cells stand for.
    if (const json now = s.system_message(); now != before) s.pages.broadcast(now);
    return json::object();
}

json restart_run(Session& s, const Request& r) {
    RunInput input = s.edited.input;
    if (r.has("seed")) input.seed = r.whole("seed");
    const auto ended = s.lost_by_rebuild();
    reset_with(s, input);
    s.log({.command = "restart",
           .title = fmt::format("restart with seed {}", input.seed),
           .scripts = begun_again(s, of_restart, input.world),
           .ended = ended});
    return {{"seed", input.seed}};
}

json set_speed(Session& s, const Request& r) {
    const auto& mode = r.text("mode");
    const bool has_value = mode == "times" || mode == "cycles";
    if (has_value && !(r.number("value") > 0)) throw InputError("a speed of 0 is a pause", "more than 0");
    s.set_speed(mode, has_value ? r.number("value") : 1);
    return json::object();
}

json open_system(Session& s, const Request& r) {
    RunInput input = s.edited.input;
    input.more.clear(), input.settings.clear(), input.text.clear(), input.world_text.clear();
    const auto path = [&](const std::string& name) {
        return r.flag("shipped") && !name.empty() ? shipped_path(s, name) : name;
    };
    input.system = path(r.text("system")), input.world = path(r.text("world"));
    check_readable(input.system, {FileKind::system, FileKind::process});
    check_readable(input.world, {FileKind::world});
    const auto before = last_use(input.system);
    input.seed = before ? before->seed : RunInput{}.seed;
    s.open_document(input);
    return json::object();
}

/// Drops the steps in another world.
void forget_world_steps(Session& s) {
    for (auto* steps : {&s.edited.steps.undo, &s.edited.steps.redo})
        std::erase_if(*steps, [](const auto& step) {
            return step.world || (!step.redo.is_null() && step.redo.at("command") == "move");
        });
}

json open_world(Session& s, const Request& r) {
    RunInput input = s.edited.input;
    input.world = r.text("world"), input.world_text.clear();
    check_readable(input.world, {FileKind::world});
    const auto ended = s.lost_by_rebuild();
    reset_with(s, input);
    s.edited.world_text.reset();
    forget_world_steps(s);
    ++s.edited.generation;
    const auto name = std::filesystem::path(input.world).filename().string();
    s.log({.command = "world_open",
           .title = name.empty() ? "restart without a world" : "restart in " + name,
           .scripts = begun_again(s, of_world, input.world),
           .ended = ended});
    s.pages.broadcast(s.world_message()), s.pages.broadcast(s.system_message()), s.broadcast_document();
    return {{"world", input.world}};
}

json list_shipped(Session& s, const Request&) {
    namespace fs = std::filesystem;
    std::vector<std::string> worlds;
    std::error_code failed;
    json systems = json::array();
    if (s.shipped().empty()) return {{"worlds", worlds}, {"systems", std::move(systems)}};
    for (const auto& entry : fs::directory_iterator(fs::path(s.shipped()) / "worlds", failed))
        if (entry.path().extension() == ".world") worlds.push_back(entry.path().string());
    std::ranges::sort(worlds);
    for (const auto& system : editing::shipped_systems(s.shipped()))
        systems.push_back({{"file", system.file},
                           {"name", system.name},
                           {"about", system.about},
                           {"kind", system.kind},
                           {"world", system.world}});
    return {{"worlds", worlds}, {"systems", std::move(systems)}};
}

/// The world of a system, or the diagram of one without a world.
json example_picture(Session& s, const Request& r) {
    constexpr double pixels = 320;  // for about half as many of the page
    const auto path = [&](const std::string& name) { return name.empty() ? name : shipped_path(s, name); };
    RunInput input;
    input.system = path(r.text("system")), input.world = path(r.text("world"));
    Diagnostics diagnostics;
    const auto loaded = checked(diagnostics, load(input, diagnostics));
    plot::Picture picture;
    if (const auto* world = loaded->world.get()) {
        const auto map = plot::WorldMap::with_floors(*world, pixels);
        picture = {map.width(), map.height(), [map, robots = world->bugs()](plot::Canvas& canvas) {
                       map.draw_ground(canvas), map.draw_movable_objects(canvas), map.draw_targets(canvas);
                       for (std::size_t i = 0; i < robots; ++i) map.draw_robot(canvas, i, false);
                   }};
    } else {
        plot::PlotSpec spec;
        spec.kind = plot::PlotSpec::Kind::diagram;
        picture = plot::structure_plot(spec, loaded->system, loaded->registry, nullptr, input.seed, "");
        picture = plot::scaled(picture, {pixels, true}, plot::Format::png);
    }
    return {{"content", base64(plot::render(picture, plot::Format::png))}};
}

json quit_program(Session& s, const Request&) {
    if (!s.quit) throw InputError("this session cannot be ended by a page");
    s.quit();
    return json::object();
}

}  // namespace

void reset_with(Session& s, RunInput input) {
    const auto before = std::exchange(s.edited.input, std::move(input));
    try {
        s.reset();
    } catch (...) {
        s.edited.input = before;
        throw;
    }
    s.note_use();
}

Equivalent begun_again(const Session& s, Equivalent (*form)(const Opened&), const std::string& world) {
    return form({s.edited.input.system, world, s.edited.input.seed, s.edited.document->dirty()});
}

std::vector<Command> run_commands() {
    const std::string undriven =
        "{ undriven: { group: string; text: string }[]; undriven_robots: { robot: string; text: string }[] }";
    return {
        {.name = "run",
         .doc = "Starts the run. Returns the groups that modules read although nothing drives them, and the "
                "robots, if nothing drives any of them.",
         .result = undriven,
         .apply = start_run},
        {.name = "run_until",
         .doc =
             "Starts the run, and pauses it when the first robot has finished so many more trials, after so "
             "many seconds of the world, or when a condition holds.",
         .arguments = {optional("trials", whole(1, 1'000'000)), optional("seconds", number(0, 1e9)),
                       optional("condition", text(), "", "as that of `forage run --until`; empty for none")},
         .result = undriven,
         .apply = run_until},
        {.name = "holds",
         .doc = "Says whether a condition holds now.",
         .arguments = {{"condition", text(), "as that of `forage run --until`"}},
         .result = "{ holds: boolean }",
         .apply = condition_holds},
        {.name = "pause", .doc = "Pauses the run.", .apply = pause_run},
        {.name = "step",
         .doc = "Pauses, then computes cycles.",
         .arguments = {optional("cycles", whole(1, 1'000'000), 1)},
         .result = "{ cycle: number }",
         .apply = step_run},
        {.name = "stop",
         .doc = "Goes back to cycle 0 with the weights of the beginning. Parameters keep their values.",
         .apply = stop_run},
        {.name = "restart",
         .doc = "Goes back to cycle 0 with another seed.",
         .arguments = {optional("seed", whole(), nullptr, "by default the present one")},
         .result = "{ seed: number }",
         .changes_run = true,
         .apply = restart_run},
        {.name = "speed",
         .doc =
             "Sets the pace: as the world, seconds of the world per second (`times`), cycles per second, or "
             "as fast as possible.",
         .arguments = {{"mode", choice({"real", "times", "cycles", "free"})},
                       optional("value", number(0, 1e9), 1, "of `times` and `cycles`")},
         .apply = set_speed},
        {.name = "open",
         .doc = "Opens another system, with the seed that it had last, or 1.",
         .arguments = {{"system", path()},
                       optional("world", path(), ""),
                       optional("shipped", boolean(), false,
                                "whether the paths are in the folder of the systems that come with Forage")},
         .changes_run = true,
         .apply = open_system},
        {.name = "world_open",
         .doc = "Begins the open system, with its edits, in another world.",
         .arguments = {{"world", path(), "empty for none"}},
         .result = "{ world: string }",
         .changes_run = true,
         .apply = open_world},
        {.name = "shipped",
         .doc = "Lists the worlds and the systems that come with Forage.",
         .result = "{ worlds: string[]; systems: ShippedSystem[] }",
         .apply = list_shipped},
        {.name = "example_picture",
         .doc =
             "Draws a small picture of a system that comes with Forage: its world, or its diagram. Returns a "
             "PNG file in base64.",
         .arguments = {{"system", path(), "below the folder of what comes with Forage"},
                       optional("world", path(), "")},
         .result = "{ content: string }",
         .apply = example_picture},
        {.name = "quit", .doc = "Ends the program.", .apply = quit_program},
    };
}

}  // namespace forage::studio
