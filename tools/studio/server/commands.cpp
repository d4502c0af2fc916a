#include "tools/studio/server/commands.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <forage/system.h>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/observe/pattern_file.h"
#include "core/observe/row_file.h"
#include "core/run/recordings.h"
#include "core/xml/panel.h"
#include "tools/api/describe_json.h"
#include "tools/studio/server/equivalents.h"
#include "tools/studio/server/session.h"

namespace forage::studio {
namespace {

constexpr std::size_t most_synapses = 200'000;  ///< in a reply
constexpr std::uint64_t most_steps = 1'000'000;

const std::map<std::string, observe::Manipulation::Mode> modes = {
    {"clamp", observe::Manipulation::Mode::clamp},
    {"add", observe::Manipulation::Mode::add},
    {"multiply", observe::Manipulation::Mode::multiply}};

std::string name_of(observe::Manipulation::Mode mode) {
    for (const auto& [name, m] : modes)
        if (m == mode) return name;
    return {};
}

/// A whole number of a command. Throws InputError.
std::uint64_t whole(const json& command, const char* member, std::uint64_t otherwise, std::uint64_t least,
                    std::uint64_t most) {
    const auto it = command.find(member);
    if (it == command.end() || it->is_null()) return otherwise;
    if (it->is_number_integer() && (it->is_number_unsigned() || it->get<std::int64_t>() >= 0)) {
        const auto value = it->get<std::uint64_t>();
        if (value >= least && value <= most) return value;
    }
    throw InputError(fmt::format("'{}' is a whole number from {} to {}", member, least, most));
}

double finite(const json& command, const char* member) {
    const double value = command.at(member).get<double>();
    if (!std::isfinite(value)) throw InputError(fmt::format("'{}' is a finite number", member));
    return value;
}

}  // namespace

/// The functions of the table.
struct Commands {
    Session& s;
    int client;
    const json& c;

    Run& run() { return *s.run_; }

    bug::World& world() {
        auto* world = dynamic_cast<bug::World*>(run().environment());
        if (!world) throw InputError("the system has no world", "open it with --world");
        return *world;
    }

    int group(const std::string& name) {
        Diagnostics diagnostics;
        const auto column = observe::find_column(run().layout(), name, "group", diagnostics);
        throw_errors(diagnostics);
        if (column->connection >= 0) throw InputError(fmt::format("'{}' is not a group", name));
        return column->group;
    }
    const engine::Layout::Group& laid(int i) { return run().layout().groups[static_cast<std::size_t>(i)]; }

    // ---- the run ----
    json start() {
        if (!s.failed_.empty()) throw InputError("the run has failed: " + s.failed_, "stop it, or go back");
        s.running_ = s.status_due_ = true;
        s.pace_from_ = s.rate_from_ = -1, s.measured_rate_ = 0;
        return json::object();
    }
    json pause() {
        s.running_ = false, s.status_due_ = true;
        return json::object();
    }
    json step() {
        const auto cycles = whole(c, "cycles", 1, 1, most_steps);
        pause();
        if (!s.failed_.empty()) throw InputError("the run has failed: " + s.failed_, "stop it, or go back");
        try {
            for (std::uint64_t i = 0; i < cycles; ++i) s.cycle();
        } catch (const engine::RunError& e) {
            s.failed_ = e.what();
            throw;
        }
        return {{"cycle", run().cycle()}};
    }
    json stop() {
        s.reset();
        return json::object();
    }
    json restart() {
        const auto before = s.input_.seed;
        s.input_.seed = whole(c, "seed", before, 0, std::numeric_limits<std::uint64_t>::max());
        try {
            s.reset();
        } catch (...) {
            s.input_.seed = before;
            throw;
        }
        return {{"seed", s.input_.seed}};
    }
    json speed() {
        const auto mode = c.at("mode").get<std::string>();
        const double value = mode == "times" || mode == "cycles" ? finite(c, "value") : 1;
        if (mode != "real" && mode != "times" && mode != "cycles" && mode != "free")
            throw InputError(fmt::format("'{}' is not a speed", mode), "real, times, cycles or free");
        if (!(value > 0 && value <= 1e9)) throw InputError("a speed is above 0, at most 1e9");
        s.set_speed(mode, value);
        return json::object();
    }
    json open() {
        RunInput input = s.input_;
        input.more.clear(), input.settings.clear(), input.text.clear();
        input.system = c.at("system").get<std::string>();
        input.world = c.value("world", "");
        s.open(std::move(input));
        s.changed_.clear(), s.undo_.clear(), s.redo_.clear();
        for (auto& [id, page] : s.clients_) page.rebind(run());
        s.tell(s.system_message()), s.tell(s.world_message());
        return json::object();
    }

    // ---- looking ----
    json subscribe() {
        const auto it = s.clients_.find(client);
        if (it == s.clients_.end()) throw InputError("only a page can subscribe");
        const auto text = c.at("source").get<std::string>();
        const auto wanted = c.value("class", "latest");
        if (wanted != "latest" && wanted != "append")
            throw InputError(fmt::format("'{}' is not a class of streams", wanted), "latest or append");
        const Delivery delivery = wanted == "append" ? Delivery::append : Delivery::latest;
        Stream stream(find_stream_source(run(), text, delivery), text, delivery,
                      whole(c, "every", 1, 1, 1'000'000'000));
        const auto number = it->second.subscribe(std::move(stream));
        const auto& kept = it->second.stream(number);
        return {{"stream", number},
                {"rows", kept.source().rows()},
                {"columns", kept.source().columns()},
                {"label", kept.source().label()},
                {"every", kept.every()}};
    }
    json unsubscribe() {
        const auto it = s.clients_.find(client);
        if (it == s.clients_.end() || !it->second.unsubscribe(c.at("stream").get<std::uint32_t>()))
            throw InputError("there is no such stream");
        return json::object();
    }
    json read() {
        const auto source = find_stream_source(run(), c.at("source").get<std::string>(), Delivery::latest);
        std::vector<double> values(static_cast<std::size_t>(source->rows()) * source->columns());
        source->read(run(), values);
        return {{"rows", source->rows()}, {"columns", source->columns()}, {"values", values}};
    }
    json synapses() {
        Diagnostics diagnostics;
        const auto item =
            model::find_item(run().system(), c.at("connection").get<std::string>(), "synapses", diagnostics);
        throw_errors(diagnostics);
        SystemFile file{
            run().system(),
            s.input_.system,
            {},
            std::shared_ptr<const Registry>(std::shared_ptr<const Registry>(), &run().registry())};
        const SynapseTable all = forage::synapses(file, item->id, run().seed());
        const auto none = std::numeric_limits<std::uint64_t>::max();
        const auto source = whole(c, "source", none, 0, none - 1),
                   target = whole(c, "target", none, 0, none - 1);
        json out = {{"source", json::array()}, {"target", json::array()},   {"distance", json::array()},
                    {"delay", json::array()},  {"strength", json::array()}, {"total", all.source.size()}};
        for (std::size_t i = 0; i < all.source.size() && out["source"].size() < most_synapses; ++i) {
            if (source != none && static_cast<std::uint64_t>(all.source[i]) != source) continue;
            if (target != none && static_cast<std::uint64_t>(all.target[i]) != target) continue;
            out["source"].push_back(all.source[i]), out["target"].push_back(all.target[i]);
            out["distance"].push_back(all.distance[i]), out["delay"].push_back(all.delay[i]);
            out["strength"].push_back(all.strength[i]);
        }
        return out;
    }
    json trials() {
        const auto robot = find_robot();
        json out = json::array();
        for (const Trial& t : world().trials(robot)) {
            json row = {{"number", t.number},
                        {"seconds", static_cast<double>(t.cycles) * run().seconds_per_cycle()},
                        {"first_cycle", t.first_cycle},
                        {"cycles", t.cycles},
                        {"reached_target", t.reached_target},
                        {"start", {t.start.x, t.start.y, t.start.yaw}},
                        {"end", {t.end.x, t.end.y, t.end.yaw}},
                        {"smallest_distance", nullptr}};
            if (std::isfinite(t.smallest_distance)) row["smallest_distance"] = t.smallest_distance;
            out.push_back(std::move(row));
        }
        return {{"trials", std::move(out)}};
    }
    std::size_t find_robot() {
        const auto name = c.value("robot", "");
        const auto found = name.empty() && world().bugs() > 0 ? 0 : world().find(name);
        if (!found)
            throw InputError(fmt::format("there is no robot '{}'", name),
                             suggest(name, world().robot_names()));
        return *found;
    }

    // ---- parameters ----
    json parameters() {
        json out = describe_parameters(run(), c.at("item").get<std::string>());
        for (auto& p : out["parameters"])
            if (const auto it = s.changed_.find(p["assignment"].get<std::string>()); it != s.changed_.end()) {
                p["loaded"] = it->second.loaded;
                if (p["at_start"]) p["value"] = value_in(it->second.assignment);
            }
        return out;
    }
    static std::string value_in(const std::string& assignment) {
        return assignment.substr(std::min(assignment.find('=') + 1, assignment.size()));
    }

    /// Checks assignments and returns those that would undo them. Throws InputError for all mistakes at once.
    std::vector<std::string> inverse(const std::vector<std::string>& assignments) {
        Diagnostics diagnostics;
        std::vector<model::Assignment> changes;
        std::vector<std::string> back;
        for (const std::string& text : assignments) {
            const auto change =
                model::parse_assignment(run().system(), run().registry(), text, "set", diagnostics);
            if (!change) continue;
            const std::string name = text.substr(0, text.find('='));
            ParameterValue now = model::value_of(run().system(), *change);
            if (const auto it = s.changed_.find(name); it != s.changed_.end() && at_start(*change)) {
                back.push_back(it->second.assignment);
            } else {
                if (!at_start(*change))
                    now = run().simulation().parameter(*change), changes.push_back(*change);
                back.push_back(name + "=" + to_text(now));
            }
        }
        run().simulation().check(changes, diagnostics);
        throw_errors(diagnostics);
        return back;
    }
    static bool at_start(const model::Assignment& a) { return !a.parameter || a.parameter->at_start; }

    json set(const std::vector<std::string>& assignments, const std::string& title, bool undoable) {
        if (assignments.empty()) throw InputError("there is nothing to set");
        const auto back = inverse(assignments);
        json values = json::object();
        for (const auto& a : assignments) values[a.substr(0, a.find('='))] = value_in(a);
        const auto same = of_assignments(assignments, run().cycle());
        s.act({{"command", "set"}, {"assignments", assignments}},
              undoable ? std::optional<json>({{"command", "set"}, {"assignments", back}}) : std::nullopt,
              {{"title", title}, {"values", values}, {"shell", same.shell}, {"python", same.python}});
        return {{"generation", s.generation_}};
    }
    json set() {
        const auto assignments = c.at("assignments").get<std::vector<std::string>>();
        std::string title = assignments.empty() ? "" : assignments.front();
        if (const auto equal = title.find('='); equal != title.npos) title.replace(equal, 1, " = ");
        if (assignments.size() > 1) title += fmt::format(" and {} more", assignments.size() - 1);
        return set(assignments, title, true);
    }
    json undo() { return back_or_forth(s.undo_, s.redo_, true); }
    json redo() { return back_or_forth(s.redo_, s.undo_, false); }
    json back_or_forth(std::vector<Session::Undo>& from, std::vector<Session::Undo>& to, bool back) {
        if (from.empty()) throw InputError(back ? "there is nothing to undo" : "there is nothing to redo");
        Session::Undo entry = std::move(from.back());
        from.pop_back();
        json told = {{"title", (back ? "undo: " : "redo: ") + entry.title}};
        const json& command = back ? entry.undo : entry.redo;
        if (command.at("command") == "set") {
            const auto same =
                of_assignments(command.at("assignments").get<std::vector<std::string>>(), run().cycle());
            told["shell"] = same.shell, told["python"] = same.python;
        }
        auto undone = std::move(s.undo_), redone = std::move(s.redo_);
        s.undo_.clear(), s.redo_.clear();
        s.act(command, std::nullopt, told);
        s.undo_ = std::move(undone), s.redo_ = std::move(redone);
        to.push_back(std::move(entry));
        return {{"generation", s.generation_}};
    }

    // ---- manipulations ----
    json describe(int number) {
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
    json manipulate() {
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
    json revoke() {
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
    json manipulations() {
        json out = json::array();
        for (const auto& [number, m] : s.touches_->groups()) out.push_back(describe(number));
        return {{"manipulations", std::move(out)}};
    }
    json patterns_read() {
        Diagnostics diagnostics;
        const auto patterns =
            observe::parse_patterns(c.at("text").get<std::string>(), c.value("file", "patterns"),
                                    laid(group(c.at("group").get<std::string>())).shape, diagnostics);
        throw_errors(diagnostics);
        return {{"patterns", patterns}};
    }
    observe::Manipulation::Settings settings_of(const json& command) {
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

    // ---- the world ----
    json move() {
        const bool robot = c.contains("robot");
        const auto name = c.at(robot ? "robot" : "object").get<std::string>();
        const auto which = robot ? find_robot() : find_object(name);
        const Pose2 now = robot ? world().pose(which) : world().movable_object_pose(which).value_or(Pose2{});
        const double x = finite(c, "x"), y = finite(c, "y");
        const double heading =
            c.contains("heading") && !c["heading"].is_null() ? finite(c, "heading") : now.yaw;
        if (std::abs(x) > 1e4 || std::abs(y) > 1e4) throw InputError("a place is within 10 km");
        s.act({{"command", "move"},
               {robot ? "robot" : "object", name},
               {"x", x},
               {"y", y},
               {"heading", heading}},
              std::nullopt,
              {{"title", fmt::format("move {} to ({:.2f}, {:.2f})", name, x, y)},
               {"shell", ""},
               {"python", ""}});
        return {{"generation", s.generation_}};
    }
    std::size_t find_object(const std::string& name) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < world().movable_objects(); ++i) {
            if (world().movable_object(i).name == name) return i;
            names.push_back(world().movable_object(i).name);
        }
        throw InputError(fmt::format("there is no movable object '{}'", name), suggest(name, names));
    }
    json begin_trial() {
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

    /// Changes the run as a noted action says.
    void apply() {
        const auto what = c.at("command").get<std::string>();
        if (what == "set") {
            for (const auto& text : c.at("assignments").get<std::vector<std::string>>()) {
                Diagnostics diagnostics;
                const auto change =
                    model::parse_assignment(run().system(), run().registry(), text, "set", diagnostics);
                throw_errors(diagnostics);
                const std::string name = text.substr(0, text.find('='));
                const auto loaded = std::visit([](const auto& v) { return json(v); },
                                               model::value_of(run().system(), *change));
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
            world().begin_trial(find_robot(), start < 0
                                                  ? std::nullopt
                                                  : std::optional(starts[static_cast<std::size_t>(start)]));
        } else if (what == "move") {
            const bool robot = c.contains("robot");
            const Pose2 pose{c.at("x").get<double>(), c.at("y").get<double>(), c.at("heading").get<double>()};
            const bool moved =
                robot ? world().move_robot(find_robot(), pose)
                      : world().move_object(find_object(c.at("object").get<std::string>()), pose);
            if (!moved)
                throw InputError("something is there already",
                                 "choose another place; a robot that is being reset cannot be moved");
        }
    }

    // ---- the sampler ----
    json sample() {
        if (s.sampler_) throw InputError("the sampler runs already", "stop it first");
        const auto file = c.at("file").get<std::string>();
        const auto sources = c.at("sources").get<std::vector<std::string>>();
        if (sources.empty()) throw InputError("the sampler needs a source");
        if (!c.value("overwrite", false) && std::filesystem::exists(file))
            throw InputError(fmt::format("'{}' exists", file), "overwrite it, or choose another name");
        const auto every = whole(c, "every", 1, 1, 1'000'000);
        std::vector<model::RecordingSpec> specs;
        for (const auto& source : sources)
            specs.push_back({{source + "=" + std::filesystem::path(file).filename().string()}, every});
        Diagnostics diagnostics;
        auto files = recorded_files(specs, {}, run().layout(), diagnostics);
        check_output(file, "samples.csv", diagnostics);
        throw_errors(diagnostics);
        if (files.size() != 1 || !files.front().archive.empty())
            throw InputError("a sampler writes one file", "its name ends with .csv, .npy, .h5 or .dat");
        observe::RowFileHeader header;
        for (const auto& source : files.front().sources) header.sources.push_back(source.what());
        header.every = every;
        Session::Sampler sampler;
        sampler.file = file, sampler.every = every;
        if (const auto cycles = whole(c, "cycles", 0, 1, 1'000'000'000'000)) sampler.left = cycles;
        sampler.recorder.emplace(observe::open_row_file(files.front().format, partial(file), header),
                                 std::move(files.front().sources),
                                 observe::Sampling{every, 0, std::nullopt, false});
        s.sampler_ = std::move(sampler);
        s.status_due_ = true;
        return {{"file", file}};
    }
    json sample_stop() {
        if (!s.sampler_) throw InputError("the sampler does not run");
        const json out = {{"file", s.sampler_->file}, {"rows", s.sampler_->rows}};
        s.close_sampler();
        return out;
    }

    // ---- layouts ----
    std::filesystem::path folder() {
        const auto parent = std::filesystem::path(s.input_.system).parent_path();
        return parent.empty() ? "." : parent;
    }
    std::string layout_path(const std::string& name) {
        if (name.empty() || name != file_name(name) || name.starts_with("."))
            throw InputError(fmt::format("'{}' is not a name of a layout", name),
                             "letters, digits, '.', '-' and '_'");
        return (folder() / (name + ".layout.json")).string();
    }
    json layouts() {
        json out = json::array();
        for (const auto& entry : std::filesystem::directory_iterator(folder())) {
            const std::string name = entry.path().filename().string();
            if (constexpr std::string_view end = ".layout.json"; name.ends_with(end))
                out.push_back(name.substr(0, name.size() - end.size()));
        }
        std::sort(out.begin(), out.end());
        return {{"layouts", std::move(out)}};
    }
    json layout_read() {
        const auto path = layout_path(c.at("name").get<std::string>());
        const json content = json::parse(read_file(path), nullptr, false);
        if (content.is_discarded()) throw InputError(fmt::format("'{}' is not a layout", path));
        return {{"content", content}};
    }
    json layout_write() {
        const auto path = layout_path(c.at("name").get<std::string>());
        write_file(path, c.at("content").dump(1) + "\n");
        return {{"file", path}};
    }

    // ---- panels and sets of parameters ----
    std::string panel_path(const char* ending) {
        auto path = c.at("file").get<std::string>();
        if (!path.ends_with(ending))
            throw InputError(fmt::format("the name of the file ends with {}", ending));
        return path;
    }
    std::vector<xml::PanelRow> panel_rows(const char* ending) {
        const auto path = panel_path(ending);
        Diagnostics diagnostics;
        auto rows = xml::parse_panel(path, read_file(path), diagnostics);
        throw_errors(diagnostics);
        return rows;
    }
    /// The parameter of an item, as `parameters` describes it. Throws InputError.
    json one_parameter(const std::string& item, const std::string& name) {
        json found = describe_parameters(run(), item);
        std::vector<std::string> names;
        for (auto& p : found["parameters"]) {
            if (p["name"] == name || p["assignment"] == name) {
                p["item"] = found["item"], p["id"] = found["id"], p["owner"] = found["kind"];
                return p;
            }
            names.push_back(p["name"]);
        }
        throw InputError(fmt::format("'{}' has no parameter '{}'", item, name), suggest(name, names));
    }
    static xml::PanelRow row_of(const json& p) {
        auto type = p["owner"].get<std::string>();
        std::transform(type.begin(), type.end(), type.begin(),
                       [](char l) { return static_cast<char>(l - 'a' + 'A'); });
        return {type,
                p["id"],
                p["name"],
                p["label"],
                p["value"].is_string() ? p["value"].get<std::string>() : p["value"].dump(),
                {}};
    }
    json panel_read() {
        json rows = json::array();
        for (const auto& r : panel_rows(".hconf")) rows.push_back(one_parameter(r.id, r.parameter));
        return {{"rows", std::move(rows)}};
    }
    json panel_write() {
        const auto path = panel_path(".hconf");
        std::vector<xml::PanelRow> rows;
        for (const auto& r : c.at("rows"))
            rows.push_back(
                row_of(one_parameter(r.at("item").get<std::string>(), r.at("parameter").get<std::string>())));
        write_file(path, xml::panel_text(rows, false));
        return {{"file", path}};
    }
    json parameters_read() {
        std::vector<std::string> assignments;
        for (const auto& r : panel_rows(".pconf"))
            assignments.push_back(one_parameter(r.id, r.parameter)["assignment"].get<std::string>() + "=" +
                                  r.value);
        return set(assignments, "parameters of " + c.at("file").get<std::string>(), true);
    }
    json parameters_write() {
        const auto path = panel_path(".pconf");
        std::vector<std::string> items = c.value("items", std::vector<std::string>());
        if (items.empty())
            for (const auto& p : run().system().processes) {
                if (p.module) items.push_back(p.id);
                for (const auto& g : p.groups) items.push_back(g.id);
            }
        if (!c.contains("items"))
            for (const auto& connection : run().system().connections) items.push_back(connection.id);
        std::vector<xml::PanelRow> rows;
        for (const auto& item : items) {
            const json found = describe_parameters(run(), item);
            for (json p : found["parameters"]) {
                p["id"] = found["id"], p["owner"] = found["kind"];
                rows.push_back(row_of(p));
            }
        }
        write_file(path, xml::panel_text(rows, true));
        return {{"file", path}, {"rows", rows.size()}};
    }

    // ---- the past ----
    json history() {
        json actions = json::array();
        for (const auto& a : s.history_.actions())
            actions.push_back({{"cycle", a.cycle}, {"title", a.title}});
        return {{"first", s.history_.first()},
                {"last", s.history_.last()},
                {"now", run().cycle()},
                {"checkpoints", s.history_.cycles()},
                {"bytes", s.history_.bytes()},
                {"limit", s.history_.limit()},
                {"interval", s.history_.interval()},
                {"actions", std::move(actions)}};
    }
    json digest() { return {{"cycle", run().cycle()}, {"digest", run().digest()}}; }
    json seek() {
        const auto cycle = whole(c, "cycle", 0, s.history_.first(), s.history_.last());
        s.go_to(cycle);
        s.status_due_ = true;
        return {{"cycle", run().cycle()}};
    }
    json branch() {
        const auto assignments = c.at("assignments").get<std::vector<std::string>>();
        inverse(assignments);
        seek();
        return set(assignments, fmt::format("from cycle {}: {}", run().cycle(), assignments.front()), true);
    }
};

void Session::apply(const json& command) { Commands{*this, -1, command}.apply(); }

void Session::act(const json& command, const std::optional<json>& undo, json told) {
    repeat_actions();
    apply(command);
    ++generation_, ++version_;
    status_due_ = true;
    const std::string title = told.at("title");
    history_.act(run_->cycle(), command, title);
    if (undo) undo_.push_back({*undo, command, title}), redo_.clear();
    told["type"] = "action", told["generation"] = generation_, told["cycle"] = run_->cycle();
    told["command"] = command.at("command"), told["undoable"] = undo.has_value();
    tell(told);
}

namespace {

struct Entry {
    json (Commands::*execute)();
    bool changes;  ///< whether it can conflict with what another page did
};

const std::map<std::string, Entry>& table() {
    static const std::map<std::string, Entry> entries = {
        {"run", {&Commands::start, false}},
        {"pause", {&Commands::pause, false}},
        {"step", {&Commands::step, false}},
        {"stop", {&Commands::stop, false}},
        {"restart", {&Commands::restart, true}},
        {"speed", {&Commands::speed, false}},
        {"open", {&Commands::open, true}},
        {"subscribe", {&Commands::subscribe, false}},
        {"unsubscribe", {&Commands::unsubscribe, false}},
        {"read", {&Commands::read, false}},
        {"synapses", {&Commands::synapses, false}},
        {"trials", {&Commands::trials, false}},
        {"parameters", {&Commands::parameters, false}},
        {"set", {&Commands::set, true}},
        {"undo", {&Commands::undo, true}},
        {"redo", {&Commands::redo, true}},
        {"manipulate", {&Commands::manipulate, true}},
        {"revoke", {&Commands::revoke, true}},
        {"manipulations", {&Commands::manipulations, false}},
        {"patterns_read", {&Commands::patterns_read, false}},
        {"move", {&Commands::move, true}},
        {"begin_trial", {&Commands::begin_trial, true}},
        {"sample", {&Commands::sample, false}},
        {"sample_stop", {&Commands::sample_stop, false}},
        {"layouts", {&Commands::layouts, false}},
        {"layout_read", {&Commands::layout_read, false}},
        {"layout_write", {&Commands::layout_write, false}},
        {"panel_read", {&Commands::panel_read, false}},
        {"panel_write", {&Commands::panel_write, false}},
        {"parameters_read", {&Commands::parameters_read, true}},
        {"parameters_write", {&Commands::parameters_write, false}},
        {"history", {&Commands::history, false}},
        {"digest", {&Commands::digest, false}},
        {"seek", {&Commands::seek, true}},
        {"branch", {&Commands::branch, true}},
    };
    return entries;
}

}  // namespace

std::vector<std::string> command_names() {
    std::vector<std::string> out;
    for (const auto& [name, entry] : table()) out.push_back(name);
    return out;
}

json execute_command(Session& session, int client, const json& command) {
    const auto name = command.at("command").get<std::string>();
    const auto it = table().find(name);
    if (it == table().end())
        throw InputError(fmt::format("there is no command '{}'", name), suggest(name, command_names()));
    if (const auto seen = command.find("generation"); it->second.changes && seen != command.end())
        if (seen->get<std::uint64_t>() != session.generation())
            throw Conflict("the run has changed since: another page has touched it");
    Commands commands{session, client, command};
    return (commands.*it->second.execute)();
}

}  // namespace forage::studio
