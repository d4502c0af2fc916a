#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"

namespace forage::bug {
namespace {

/// At most three decimals, without trailing zeros.
std::string number(double v) {
    std::string out = fmt::format("{:.3f}", v);
    out.erase(out.find_last_not_of('0') + 1);
    if (out.ends_with('.')) out.pop_back();
    return out == "-0" ? "0" : out;
}

std::string at(const Pose2& p) {
    return fmt::format("({}, {}) heading {}", number(p.x), number(p.y), number(p.yaw));
}

}  // namespace

std::string describe(const World& world) {
    std::string out = std::filesystem::path(world.description().path).filename().string() + "\n";
    const auto line = [&](std::string_view label, const std::string& text) {
        out += fmt::format("  {:12}{}\n", label, text);
    };
    const auto names = world.robot_names();
    std::size_t with_resets = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        line("robot", fmt::format("{} at {}", names[i], at(world.snapshot(i).pose)));
        with_resets += world.has_trials(i);
    }
    if (names.empty()) line("robot", "none");
    std::size_t removed = 0;
    for (std::size_t i = 0; i < world.movable_objects(); ++i) {
        if (const auto pose = world.movable_object_pose(i))
            line(world.movable_object(i).resource ? "resource" : "object",
                 fmt::format("{} at {}", world.movable_object(i).name, at(*pose)));
        else
            ++removed;
    }
    if (removed) line("resource", fmt::format("{} that appear during the game", removed));
    const Game& game = world.game();
    if (!game.empty()) {
        for (int team = 0; team < 2; ++team) {
            const Pose2& home = game.homes()[static_cast<std::size_t>(team)];
            line("home", fmt::format("of team {} at ({}, {}), radius {}", team ? "B" : "A", number(home.x),
                                     number(home.y), number(Game::home_radius)));
        }
        if (game.timed()) line("game", fmt::format("{} s", number(game.left())));
    }
    const auto plan = world.reset_plan();
    if (plan)
        for (std::size_t i = 0; i < plan->starts.size(); ++i)
            line("start", fmt::format("{} at {}", plan->names[i], at(plan->starts[i])));
    for (const auto& t : world.targets())
        line("target", fmt::format("({}, {})", number(t.x()), number(t.y())));
    if (world.targets().empty()) line("target", "none");
    if (plan)
        line("bounds", fmt::format("x {} to {}, y {} to {}", number(plan->bounds.min().x()),
                                   number(plan->bounds.max().x()), number(plan->bounds.min().y()),
                                   number(plan->bounds.max().y())));
    line("trials",
         !plan          ? "none: there are no start poses (models named Reset_0 to Reset_9)"
         : !with_resets ? "none: no robot has the plugin libreset_plugin.so"
         : !world.description().trials
             ? "a robot that leaves the bounds is reset to a start pose"
             : fmt::format("end within {} m of a target{}, or outside the bounds",
                           number(world.description().trials->reach),
                           world.description().trials->duration < 1e9
                               ? fmt::format(", after {} s", number(world.description().trials->duration))
                               : ""));
    line("time", fmt::format("{} s of simulated time per cycle", number(world.seconds_per_cycle())));
    out += "  in m and rad; heading 0 is along x, 1.571 along y\n";
    return out;
}

}  // namespace forage::bug
