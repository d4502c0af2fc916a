#include <algorithm>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/observe/pattern_file.h"
#include "tools/api/open/moves.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {
namespace {

using Manipulation = observe::Manipulation;
using Patterns = std::vector<std::vector<double>>;
using Spec = model::ManipulationSpec;

/// The number of a group. Throws InputError.
int find_group(const Run& run, const std::string& name) {
    Diagnostics diagnostics;
    const auto column = checked(diagnostics, observe::find_column(run.layout(), name, "group", diagnostics));
    if (column->connection >= 0) throw InputError(fmt::format("'{}' is not a group", name));
    return column->group;
}

const engine::Layout::Group& group_at(const Run& run, int number) {
    return run.layout().groups[static_cast<std::size_t>(number)];
}

const engine::Layout::Group& group_of(const Run& run, const std::string& name) {
    return group_at(run, find_group(run, name));
}

/// Patterns for a group. Throws InputError when they do not fit it.
Patterns patterns_for(const engine::Layout::Group& group, const json& given) {
    auto out = given.get<Patterns>();
    if (out.empty()) throw InputError("a manipulation needs a pattern");
    const auto cells = static_cast<std::size_t>(group.shape.cells);
    for (const auto& p : out)
        if (p.size() != cells)
            throw InputError(fmt::format("'{}' has {} cells, the pattern {}", group.path, cells, p.size()));
    return out;
}

/// The settings in an action. Throws InputError.
Manipulation::Settings settings_in(const Run& run, const json& action) {
    Manipulation::Settings out;
    out.group = find_group(run, action.at("group").get<std::string>());
    const auto& mode = action.at("mode").get_ref<const std::string&>();
    out.mode = static_cast<Spec::Mode>(std::ranges::find(Spec::modes, mode) - Spec::modes.begin());
    out.patterns = patterns_for(group_at(run, out.group), action.at("patterns"));
    out.every = action.at("every"), out.step = action.at("step"), out.backwards = action.at("backwards");
    if (const auto it = action.find("times"); it != action.end() && !it->is_null()) out.times = *it;
    if (out.step > out.patterns.size())
        throw InputError(
            fmt::format("'step' is {}, more than the {} patterns", out.step, out.patterns.size()));
    return out;
}

/// The action that makes the manipulation of a group what it is now.
json present_action(Session& s, const json& action) {
    const int group = find_group(s.run(), action.at("group").get<std::string>());
    const auto& found = s.live.manipulations->groups();
    const auto it = found.find(group);
    if (it == found.end()) return {{"command", "revoke"}, {"group", group_at(s.run(), group).path}};
    const auto& m = it->second.settings();
    return {{"command", "manipulate"},
            {"group", group_at(s.run(), group).path},
            {"mode", Spec::name_of(m.mode)},
            {"patterns", m.patterns},
            {"every", m.every},
            {"step", m.step},
            {"times", m.times ? json(*m.times) : json(nullptr)},
            {"backwards", m.backwards}};
}

json manipulate_group(Session& s, const Request& r) {
    json action = r.all();
    action["command"] = "manipulate";
    const auto settings = settings_in(s.run(), action);  // also checks
    const auto& path = group_at(s.run(), settings.group).path;
    action["group"] = path;
    return take_step(s, action,
                     {.title = fmt::format("{} {}", Spec::name_of(settings.mode), path), .item = path});
}

DrivenGroup driven_by(Session& s, const json& manipulation) {
    const auto settings = settings_in(s.run(), manipulation);
    const auto& g = group_at(s.run(), settings.group);
    const bool full = g.shape.cells == g.shape.width * g.shape.height;
    return {g.path,
            Spec::name_of(settings.mode),
            settings.patterns,
            full ? g.shape.width : g.shape.cells,
            settings.every,
            settings.step,
            settings.times,
            settings.backwards};
}

Equivalent script_manipulate(Session& s, const json& action) {
    return of_manipulation(driven_by(s, action), s.run().cycle());
}

json revoke_manipulation(Session& s, const Request& r) {
    const int group = find_group(s.run(), r.text("group"));
    const auto& path = group_at(s.run(), group).path;
    if (!s.live.manipulations->groups().contains(group))
        throw InputError(fmt::format("'{}' is not manipulated", path));
    return take_step(s, {{"command", "revoke"}, {"group", path}}, {.title = "revoke " + path, .item = path});
}

Equivalent script_revoke(Session& s, const json& action) {
    const auto now = present_action(s, action);
    if (now.at("command") != "manipulate") return {};
    const auto& actions = s.live.history.actions();
    const auto begun = std::find_if(actions.rbegin(), actions.rend(), [&](const auto& a) {
        return a.command.at("command") == "manipulate" && a.command.at("group") == now.at("group");
    });
    return of_end(driven_by(s, now), begun == actions.rend() ? 0 : begun->cycle, s.run().cycle());
}

json list_manipulations(Session& s, const Request&) {
    json out = json::array();
    for (const auto& [group, m] : s.live.manipulations->groups()) {
        out.push_back(present_action(s, {{"group", group_at(s.run(), group).path}}));
        out.back().erase("command");
    }
    return {{"manipulations", std::move(out)}};
}

json read_patterns(Session& s, const Request& r) {
    if (r.has("file") == r.has("text") && !r.has("text"))
        throw InputError("command 'patterns_read': 'file' is missing",
                         "a path, or the 'text' of such a file");
    Diagnostics diagnostics;
    const auto shape = group_of(s.run(), r.text("group")).shape;
    const auto file = r.has("file") ? r.text("file") : "patterns";
    if (!r.has("text")) check_readable(file, {FileKind::patterns});
    const auto patterns = r.has("text") ? observe::parse_patterns(r.text("text"), file, shape, diagnostics)
                                        : observe::read_patterns(file, shape, diagnostics);
    throw_errors(diagnostics);
    return {{"patterns", patterns}};
}

json write_patterns(Session& s, const Request& r) {
    const auto& file = r.text("file");
    const auto& group = group_of(s.run(), r.text("group"));
    const auto patterns = patterns_for(group, r["patterns"]);
    check_writable(s, file, FileKind::patterns, r.flag("overwrite"));
    write_file(file, observe::patterns_text(patterns, group.shape));
    return {{"file", file}};
}

/// The pose of a robot or a movable object; empty when there is none of this name.
std::optional<Pose2> pose_of(const bug::World& world, const std::string& name) {
    if (const auto robot = world.find(name)) return world.pose(*robot);
    for (std::size_t i = 0; i < world.movable_objects(); ++i)
        if (world.movable_object(i).name == name) return world.movable_object_pose(i);
    return {};
}

json move_body(Session& s, const Request& r) {
    if (r.has("robot") == r.has("object"))
        throw InputError("command 'move': exactly one of 'robot' and 'object' is needed", "a name");
    const char* const kind = r.has("robot") ? "robot" : "object";
    const auto& name = r.text(kind);
    const double x = r.number("x"), y = r.number("y");
    const double heading =
        r.has("heading") ? r.number("heading") : pose_of(world_of(s.run()), name).value_or(Pose2{}).yaw;
    return take_step(s, {{"command", "move"}, {kind, name}, {"x", x}, {"y", y}, {"heading", heading}},
                     {.title = fmt::format("move {} to ({:.2f}, {:.2f})", name, x, y)},
                     {.merge = r.text("merge")});
}

std::string moved_body(const json& action) {
    return action.at(action.contains("robot") ? "robot" : "object").get<std::string>();
}

json move_back(Session& s, const json& action) {
    json out = action;
    if (const auto pose = pose_of(world_of(s.run()), moved_body(action)))
        out["x"] = pose->x, out["y"] = pose->y, out["heading"] = pose->yaw;
    return out;
}

json begin_next_trial(Session& s, const Request& r) {
    const auto robot = world_of(s.run()).robot_names()[find_robot(s, r)];
    const auto start = r["start"].get<int>();
    const json action = {{"command", "begin_trial"}, {"robot", robot}, {"start", start}};
    const auto title = start < 0 ? "next trial" : fmt::format("next trial from start {}", start + 1);
    s.act(action, {.title = title});
    return {{"generation", s.edited.generation}};
}

void repeat_begin_trial(Course& course, const json& action) {
    const auto start = action.at("start").get<int>();
    begin_trial(*course.run, action.at("robot").get<std::string>(),
                start < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(start)));
}

}  // namespace

std::vector<Command> intervening_commands() {
    const Member group{"group", text(), "a path"};
    const Member patterns{"patterns", list(list(number())), "each one number per cell"};
    const std::string generation = "{ generation: number }";
    return {
        {.name = "manipulate",
         .doc = "Replaces the manipulation of a group.",
         .arguments = {group, patterns,
                       optional("mode", choice({Spec::modes.begin(), Spec::modes.end()}), "clamp"),
                       optional("every", whole(1, 1'000'000'000), 1, "cycles per pattern"),
                       optional("step", whole(1, 1'000'000'000), 1, "patterns"),
                       optional("times", whole(1, 1'000'000'000), nullptr, "by default endlessly"),
                       optional("backwards", boolean(), false)},
         .result = generation,
         .changes_run = true,
         .apply = manipulate_group,
         .repeat = [](Course& c, const json& action) { c.manipulations->put(settings_in(*c.run, action)); },
         .inverse = present_action,
         .script = script_manipulate},
        {.name = "revoke",
         .doc = "Ends the manipulation of a group.",
         .arguments = {group},
         .result = generation,
         .changes_run = true,
         .apply = revoke_manipulation,
         .repeat =
             [](Course& c, const json& action) {
                 c.manipulations->remove(find_group(*c.run, action.at("group").get<std::string>()));
             },
         .inverse = present_action,
         .script = script_revoke},
        {.name = "manipulations",
         .doc = "Lists the manipulations that act now.",
         .result = "{ manipulations: Driven[] }",
         .apply = list_manipulations},
        {.name = "patterns_read",
         .doc = "Reads a [file of patterns](../reference/expressions.md#manipulations).",
         .arguments = {group, optional("file", path()), optional("text", text(), nullptr, "of such a file")},
         .result = "{ patterns: number[][] }",
         .apply = read_patterns},
        {.name = "patterns_write",
         .doc = "Writes a file of patterns.",
         .arguments = {group, patterns, {"file", path(), "`.txt`"}, optional("overwrite", boolean(), false)},
         .result = "{ file: string }",
         .apply = write_patterns},
        {.name = "move",
         .doc = "Moves a robot or an object to a free place, in m and rad. The trial continues.",
         .arguments = {optional("robot", text()),
                       optional("object", text()),
                       {"x", number()},
                       {"y", number()},
                       optional("heading", number(), nullptr, "by default the present one"),
                       optional("merge", text(), "",
                                "a step is undone with the steps of the same name before it")},
         .result = generation,
         .changes_run = true,
         .apply = move_body,
         .repeat =
             [](Course& c, const json& action) {
                 move(*c.run, moved_body(action), action.at("x"), action.at("y"),
                      action.at("heading").get<double>());
             },
         .inverse = move_back,
         .script =
             [](Session& s, const json& action) {
                 return of_move(moved_body(action), action.at("x"), action.at("y"), action.at("heading"),
                                s.run().cycle());
             }},
        {.name = "begin_trial",
         .doc = "Ends the trial of a robot and begins the next one.",
         .arguments = {optional("robot", text(), "", "by default the first"),
                       optional("start", whole(-1, 2'147'483'647), -1,
                                "an index into `starts`; -1 for the next")},
         .result = generation,
         .changes_run = true,
         .apply = begin_next_trial,
         .repeat = repeat_begin_trial,
         .script =
             [](Session& s, const json& action) {
                 return of_trial(action.at("robot").get<std::string>(), action.at("start"), s.run().cycle());
             }},
    };
}

}  // namespace forage::studio
