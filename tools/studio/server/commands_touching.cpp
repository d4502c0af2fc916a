#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/observe/pattern_file.h"
#include "tools/studio/server/command_functions.h"
#include "tools/studio/server/equivalents.h"

namespace forage::studio {
namespace {

const std::map<std::string, observe::Manipulation::Mode> modes = {
    {"clamp", observe::Manipulation::Mode::clamp},
    {"add", observe::Manipulation::Mode::add},
    {"multiply", observe::Manipulation::Mode::multiply}};

std::string name_of(observe::Manipulation::Mode mode) {
    for (const auto& [name, m] : modes)
        if (m == mode) return name;
    return {};
}

}  // namespace

json Commands::describe(int number) {
    const auto& found = s.touches_->groups();
    const auto it = found.find(number);
    if (it == found.end()) return {{"command", "revoke"}, {"group", laid(number).path}};
    const auto& m = it->second.settings();
    return {{"command", "manipulate"},
            {"group", laid(number).path},
            {"mode", name_of(m.mode)},
            {"patterns", m.patterns},
            {"every", m.every},
            {"step", m.step},
            {"times", m.times ? json(*m.times) : json(nullptr)},
            {"backwards", m.backwards}};
}

json Commands::manipulate() {
    const int number = group(c.at("group").get<std::string>());
    json command = c;
    command.erase("id"), command.erase("generation");
    const auto settings = settings_of(command);  // also checks
    const auto& g = laid(number);
    const auto mode = name_of(settings.mode);
    const auto same =
        of_manipulation(g.path, mode, settings.patterns,
                        g.shape.cells == g.shape.width * g.shape.height ? g.shape.width : g.shape.cells,
                        settings.every, run().cycle());
    s.act(command, describe(number),
          {{"title", fmt::format("{} {}", mode, g.path)},
           {"item", g.path},
           {"shell", same.shell},
           {"python", same.python}});
    return {{"generation", s.generation_}};
}

json Commands::revoke() {
    const int number = group(c.at("group").get<std::string>());
    if (!s.touches_->groups().contains(number))
        throw InputError(fmt::format("'{}' is not manipulated", laid(number).path));
    s.act({{"command", "revoke"}, {"group", laid(number).path}}, describe(number),
          {{"title", "revoke " + laid(number).path},
           {"item", laid(number).path},
           {"shell", fmt::format("; until cycle {}", run().cycle())},
           {"python", "manipulation.remove()"}});
    return {{"generation", s.generation_}};
}

json Commands::manipulations() {
    json out = json::array();
    for (const auto& [number, m] : s.touches_->groups()) out.push_back(describe(number));
    return {{"manipulations", std::move(out)}};
}

json Commands::patterns_read() {
    Diagnostics diagnostics;
    const auto patterns =
        observe::parse_patterns(c.at("text").get<std::string>(), c.value("file", "patterns"),
                                laid(group(c.at("group").get<std::string>())).shape, diagnostics);
    throw_errors(diagnostics);
    return {{"patterns", patterns}};
}

observe::Manipulation::Settings Commands::settings_of(const json& command) {
    observe::Manipulation::Settings out;
    out.group = group(command.at("group").get<std::string>());
    const auto mode = command.value("mode", "clamp");
    const auto found = modes.find(mode);
    if (found == modes.end())
        throw InputError(fmt::format("'{}' is not a manipulation", mode), "clamp, add or multiply");
    out.mode = found->second;
    out.patterns = command.at("patterns").get<std::vector<std::vector<double>>>();
    if (out.patterns.empty()) throw InputError("a manipulation needs a pattern");
    const auto cells = static_cast<std::size_t>(laid(out.group).shape.cells);
    for (const auto& p : out.patterns)
        if (p.size() != cells)
            throw InputError(
                fmt::format("'{}' has {} cells, the pattern {}", laid(out.group).path, cells, p.size()));
    out.every = whole(command, "every", 1, 1, 1'000'000'000);
    out.step = whole(command, "step", 1, 1, out.patterns.size());
    if (command.contains("times") && !command["times"].is_null())
        out.times = whole(command, "times", 1, 1, 1'000'000'000);
    out.backwards = command.value("backwards", false);
    return out;
}

json Commands::move() {
    const bool robot = c.contains("robot");
    const auto name = c.at(robot ? "robot" : "object").get<std::string>();
    const auto which = robot ? find_robot() : find_object(name);
    const Pose2 now = robot ? world().pose(which) : world().movable_object_pose(which).value_or(Pose2{});
    const double x = finite(c, "x"), y = finite(c, "y");
    const double heading = c.contains("heading") && !c["heading"].is_null() ? finite(c, "heading") : now.yaw;
    if (std::abs(x) > 1e4 || std::abs(y) > 1e4) throw InputError("a place is within 10 km");
    s.act({{"command", "move"}, {robot ? "robot" : "object", name}, {"x", x}, {"y", y}, {"heading", heading}},
          std::nullopt,
          {{"title", fmt::format("move {} to ({:.2f}, {:.2f})", name, x, y)}, {"shell", ""}, {"python", ""}});
    return {{"generation", s.generation_}};
}

std::size_t Commands::find_object(const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < world().movable_objects(); ++i) {
        if (world().movable_object(i).name == name) return i;
        names.push_back(world().movable_object(i).name);
    }
    throw InputError(fmt::format("there is no movable object '{}'", name), suggest(name, names));
}

json Commands::begin_trial() {
    const auto robot = find_robot();
    const int start = c.value("start", -1);
    const auto starts = world().start_poses();
    if (start >= static_cast<int>(starts.size()))
        throw InputError(fmt::format("there are {} start poses", starts.size()));
    s.act({{"command", "begin_trial"}, {"robot", world().robot_names()[robot]}, {"start", start}},
          std::nullopt,
          {{"title", start < 0 ? "next trial" : fmt::format("next trial from start {}", start + 1)},
           {"shell", ""},
           {"python", ""}});
    return {{"generation", s.generation_}};
}

void Commands::apply() {
    const auto what = c.at("command").get<std::string>();
    if (what == "set") {
        for (const auto& text : c.at("assignments").get<std::vector<std::string>>()) {
            Diagnostics diagnostics;
            const auto change =
                model::parse_assignment(run().system(), run().registry(), text, "set", diagnostics);
            throw_errors(diagnostics);
            const std::string name = text.substr(0, text.find('='));
            const auto loaded =
                std::visit([](const auto& v) { return json(v); }, model::value_of(run().system(), *change));
            s.changed_.try_emplace(name, Session::Change{{}, loaded}).first->second.assignment = text;
            if (!at_start(*change)) run().simulation().set(*change);
        }
    } else if (what == "manipulate") {
        s.touches_->put(settings_of(c));
    } else if (what == "revoke") {
        s.touches_->remove(group(c.at("group").get<std::string>()));
    } else if (what == "begin_trial") {
        const int start = c.value("start", -1);
        const auto starts = world().start_poses();
        world().begin_trial(
            find_robot(), start < 0 ? std::nullopt : std::optional(starts[static_cast<std::size_t>(start)]));
    } else if (what == "move") {
        const bool robot = c.contains("robot");
        const Pose2 pose{c.at("x").get<double>(), c.at("y").get<double>(), c.at("heading").get<double>()};
        const bool moved = robot ? world().move_robot(find_robot(), pose)
                                 : world().move_object(find_object(c.at("object").get<std::string>()), pose);
        if (!moved)
            throw InputError("something is there already",
                             "choose another place; a robot that is being reset cannot be moved");
    }
}

}  // namespace forage::studio
