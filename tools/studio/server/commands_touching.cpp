#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/observe/pattern_file.h"
#include "tools/api/moves.h"
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

Equivalent Commands::same(const json& command) {
    const auto what = command.at("command").get<std::string>();
    const auto driven = [&](const json& manipulation) {
        const auto settings = settings_of(manipulation);
        const auto& g = laid(settings.group);
        return DrivenGroup{g.path,
                           name_of(settings.mode),
                           settings.patterns,
                           g.shape.cells == g.shape.width * g.shape.height ? g.shape.width : g.shape.cells,
                           settings.every,
                           settings.step,
                           settings.times,
                           settings.backwards};
    };
    if (what == "set")
        return of_assignments(command.at("assignments").get<std::vector<std::string>>(), run().cycle());
    if (what == "manipulate") return of_manipulation(driven(command), run().cycle());
    if (what == "move")
        return of_move(command.at(command.contains("robot") ? "robot" : "object").get<std::string>(),
                       command.at("x"), command.at("y"), command.at("heading"), run().cycle());
    if (what == "begin_trial")
        return of_trial(command.at("robot").get<std::string>(), command.at("start"), run().cycle());
    if (what == "revoke") {
        const auto now = describe(group(command.at("group").get<std::string>()));
        const auto& actions = s.history_.actions();
        const auto begun = std::find_if(actions.rbegin(), actions.rend(), [&](const auto& a) {
            return a.command.at("command") == "manipulate" && a.command.at("group") == now.at("group");
        });
        if (now.at("command") == "manipulate")
            return of_end(driven(now), begun == actions.rend() ? 0 : begun->cycle, run().cycle());
    }
    return {};
}

json Commands::manipulate() {
    json command = c;
    command.erase("id"), command.erase("generation");
    const auto settings = settings_of(command);  // also checks
    const auto& path = laid(settings.group).path;
    command["group"] = path;
    s.act(command, describe(settings.group),
          told(command, fmt::format("{} {}", name_of(settings.mode), path), path));
    return {{"generation", s.generation_}};
}

json Commands::told(const json& command, const std::string& title, const std::string& item) {
    const auto forms = same(command);
    json out = {{"title", title}, {"shell", forms.shell}, {"python", forms.python}};
    if (!item.empty()) out["item"] = item;
    return out;
}

json Commands::revoke() {
    const int number = group(c.at("group").get<std::string>());
    const auto& path = laid(number).path;
    if (!s.touches_->groups().contains(number))
        throw InputError(fmt::format("'{}' is not manipulated", path));
    const json command = {{"command", "revoke"}, {"group", path}};
    s.act(command, describe(number), told(command, "revoke " + path, path));
    return {{"generation", s.generation_}};
}

json Commands::manipulations() {
    json out = json::array();
    for (const auto& [number, m] : s.touches_->groups()) out.push_back(describe(number));
    return {{"manipulations", std::move(out)}};
}

json Commands::patterns_read() {
    Diagnostics diagnostics;
    const auto shape = laid(group(c.at("group").get<std::string>())).shape;
    const auto patterns = c.contains("text")
                              ? observe::parse_patterns(c["text"].get<std::string>(),
                                                        c.value("file", "patterns"), shape, diagnostics)
                              : observe::read_patterns(c.at("file").get<std::string>(), shape, diagnostics);
    throw_errors(diagnostics);
    return {{"patterns", patterns}};
}

json Commands::patterns_write() {
    const auto file = c.at("file").get<std::string>();
    if (std::filesystem::path(file).extension() != ".txt")
        throw InputError("the name of a file of patterns ends with .txt");
    const auto settings = settings_of(c);  // also checks
    check_free(file);
    write_file(file, observe::patterns_text(settings.patterns, laid(settings.group).shape));
    return {{"file", file}};
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
    const double x = finite(c, "x"), y = finite(c, "y");
    const auto before = pose_of(name);
    const double heading = c.contains("heading") && !c["heading"].is_null() ? finite(c, "heading")
                                                                            : before.value_or(Pose2{}).yaw;
    const auto to = [&](const Pose2& pose) -> json {
        return {{"command", "move"},
                {robot ? "robot" : "object", name},
                {"x", pose.x},
                {"y", pose.y},
                {"heading", pose.yaw}};
    };
    const json command = to({x, y, heading});
    const std::string merge = c.value("merge", "");
    const bool joined = s.joins_move(merge);
    const auto title = fmt::format("move {} to ({:.2f}, {:.2f})", name, x, y);
    s.act(command, before && !joined ? std::optional(to(*before)) : std::nullopt, told(command, title));
    if (joined)
        s.undo_.back().redo = command, s.undo_.back().title = title, s.redo_.clear();
    else if (before)
        s.undo_.back().merge = merge;
    return {{"generation", s.generation_}};
}

/// The pose of a robot or a movable object; empty when there is none of this name.
std::optional<Pose2> Commands::pose_of(const std::string& name) {
    const auto& w = world();
    if (const auto robot = w.find(name)) return w.pose(*robot);
    for (std::size_t i = 0; i < w.movable_objects(); ++i)
        if (w.movable_object(i).name == name) return w.movable_object_pose(i);
    return {};
}

json Commands::begin_trial() {
    const auto robot = find_robot();
    const int start = c.value("start", -1);
    const json command = {
        {"command", "begin_trial"}, {"robot", world().robot_names()[robot]}, {"start", start}};
    s.act(command, std::nullopt,
          told(command, start < 0 ? "next trial" : fmt::format("next trial from start {}", start + 1)));
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
        forage::begin_trial(run(), c.at("robot").get<std::string>(),
                            start < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(start)));
    } else if (what == "move") {
        forage::move(run(), c.at(c.contains("robot") ? "robot" : "object").get<std::string>(), c.at("x"),
                     c.at("y"), c.at("heading").get<double>());
    }
}

}  // namespace forage::studio
