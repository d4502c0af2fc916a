#include "tools/forage/results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bug_interface/versions.h"
#include "tools/forage/files.h"

namespace forage::tool {
namespace {

std::string_view outcome_of(const bug::Trial& t, bool finished) {
    if (t.target()) return "target";
    return finished ? "missed" : "unfinished";
}

/// A file that a run has read, with a digest (64-bit FNV-1a) that tells whether it has changed since.
nlohmann::ordered_json input_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::istreambuf_iterator<char> at(in), end; at != end; ++at)
        hash = (hash ^ static_cast<unsigned char>(*at)) * 0x100000001b3u;
    return {{"file", path}, {"fnv1a64", fmt::format("{:016x}", hash)}};
}

std::string base_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// "8 of 8 from (-1.5, -2), ..." by start position, for worlds that reset the robot to several.
std::string by_start(const bug::World& world, const Trials& trials) {
    const auto plan = world.reset_plan();
    if (!plan || plan->starts.size() < 2) return {};
    std::vector<std::pair<int, int>> counts(plan->starts.size());
    for (const auto& t : trials.finished) {
        const auto nearest =
            std::min_element(plan->starts.begin(), plan->starts.end(), [&](const auto& a, const auto& b) {
                return std::hypot(a.x - t.start.x, a.y - t.start.y) <
                       std::hypot(b.x - t.start.x, b.y - t.start.y);
            });
        auto& [reached, all] = counts[static_cast<std::size_t>(nearest - plan->starts.begin())];
        ++all, reached += t.target();
    }
    std::string out;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i].second)
            out += fmt::format("{}{} of {} from ({:g}, {:g})", out.empty() ? "" : ", ", counts[i].first,
                               counts[i].second, plan->starts[i].x, plan->starts[i].y);
    return out;
}

/// The lines of a summary about one robot.
template <class Line>
void robot_summary(const bug::World& world, std::size_t robot, const Line& line) {
    const Trials trials = trials_of(world, robot);
    const std::string name = world.bugs() > 1 ? world.bug_names()[robot] + " " : "";
    if (const auto n = trials.finished.size()) {
        double cycles = 0;
        for (const auto& t : trials.finished) cycles += static_cast<double>(t.cycles);
        line(name + "trials", fmt::format("{}, {:.1f} s each on average, and 1 s to put the robot back", n,
                                          cycles / static_cast<double>(n) * world.seconds_per_cycle()));
        if (world.targets().empty()) return;
        const std::string starts = by_start(world, trials);
        line(name + "at the target",
             fmt::format("{} of {} ({:.0f} %){}", trials.reached(), n,
                         100.0 * static_cast<double>(trials.reached()) / static_cast<double>(n),
                         starts.empty() ? "" : ": " + starts));
    } else if (trials.running) {
        const auto& t = *trials.running;
        const auto place = [](const bug::Pose2& p) {  // + 0.0: no minus before a zero
            return fmt::format("({:.2f}, {:.2f})", std::round(p.x * 100) / 100 + 0.0,
                               std::round(p.y * 100) / 100 + 0.0);
        };
        line(name + "robot", fmt::format("from {} to {}, {:.2f} m apart", place(t.start), place(t.end),
                                         std::hypot(t.end.x - t.start.x, t.end.y - t.start.y)));
        if (!world.targets().empty())
            line(name + "target", fmt::format("{:.2f} m away at the nearest{}", t.smallest_distance,
                                              t.target() ? ": reached" : ""));
    }
}

}  // namespace

std::size_t Trials::reached() const {
    return static_cast<std::size_t>(
        std::count_if(finished.begin(), finished.end(), [](const auto& t) { return t.target(); }));
}

Trials trials_of(const bug::World& world, std::size_t robot) {
    Trials out{world.trials(robot), std::nullopt};
    const auto running = world.current_trial(robot);
    if (running.cycles > 0) out.running = running;
    return out;
}

std::string trials_csv(const Trials& trials) {
    std::string out =
        "trial,start_x,start_y,start_yaw,cycles,smallest_distance,outcome,first_cycle,end_x,end_y,end_yaw\n";
    const auto add = [&](const bug::Trial& t, bool finished) {
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", t.number, t.start.x, t.start.y, t.start.yaw,
                           t.cycles, t.smallest_distance, outcome_of(t, finished), t.first_cycle, t.end.x,
                           t.end.y, t.end.yaw);
    };
    for (const auto& t : trials.finished) add(t, true);
    if (trials.running) add(*trials.running, false);
    return out;
}

std::string run_json(const RunOptions& o, const Loaded& loaded, const Outcome& outcome) {
    nlohmann::ordered_json json;
    json["forage"] = FORAGE_VERSION;
    json["libraries"]["Eigen"] =
        fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
    for (const auto& [name, version] : bug::library_versions()) json["libraries"][name] = version;
    json["compiler"] = __VERSION__;
    json["system"] = input_file(o.input.system);
    json["system"]["name"] = loaded.system.name;
    json["system"]["cycles_per_second"] = cycles_per_second(loaded.system);
    if (loaded.world) {
        json["world"] = input_file(o.input.world);
        json["world"]["seconds_per_cycle"] = loaded.world->seconds_per_cycle();
        json["world"]["noise"] = o.input.noise;
    }
    json["seed"] = o.input.seed;
    if (outcome.length) json["cycles"] = *outcome.length;
    if (o.trials) json["trials"] = *o.trials, json["longest_trial"] = o.longest_trial;
    if (o.input.world_pace) json["world_pace"] = *o.input.world_pace;
    json["set"] = o.input.settings;
    json["record"] = o.recordings;
    json["every"] = o.every;
    if (!o.input.drive.empty()) json["drive"] = input_file(o.input.drive);
    if (!o.at.empty()) json["at"] = o.at;
    if (!o.clamp.empty()) json["clamp"] = o.clamp;
    json["lenient"] = o.input.lenient;
    auto& result = json["result"];
    result["cycles"] = outcome.cycles;
    result["seconds"] = outcome.seconds;
    if (!outcome.stopped.empty()) result["stopped"] = outcome.stopped;
    for (const auto& [text, cycle] : outcome.changes)
        result["changes"].push_back(
            {{"at", text}, {"cycle", cycle ? nlohmann::ordered_json(*cycle) : nlohmann::ordered_json()}});
    if (loaded.world)
        for (std::size_t i = 0; i < loaded.world->bugs(); ++i) {
            const Trials trials = trials_of(*loaded.world, i);
            result["robots"].push_back({{"name", loaded.world->bug_names()[i]},
                                        {"trials", trials.finished.size()},
                                        {"at_target", trials.reached()}});
        }
    result["files"] = outcome.files;
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<std::string> files_of_last_run(const std::string& directory) {
    std::vector<std::string> out;
    std::ifstream in(directory + "/run.json");
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.contains("forage") || !json.contains("result")) return out;
    const auto files = json["result"].value("files", nlohmann::json::array());
    for (const auto& f : files)
        if (f.is_string() && f.get<std::string>() == file_name(f.get<std::string>())) out.push_back(f);
    return out;
}

std::string picture_title(const RunOptions& o, const Loaded& loaded) {
    return fmt::format("{}{}, seed {}", base_name(o.input.system),
                       loaded.world ? " in " + base_name(o.input.world) : "", o.input.seed);
}

std::string summary(const RunOptions& o, const Loaded& loaded, const Outcome& outcome) {
    std::string out = picture_title(o, loaded) + "\n";
    const auto line = [&](std::string_view name, const std::string& text) {
        out += fmt::format("  {:<14} {}\n", name, text);
    };
    if (!outcome.stopped.empty()) line("stopped", outcome.stopped);
    line("cycles", fmt::format("{} ({:.1f} s {})", outcome.cycles, outcome.seconds,
                               loaded.world ? "in the world" : "at the system's pace"));
    line("speed", fmt::format("{:.0f} cycles/s, {:.0f} x real time ({:.2f} s)",
                              static_cast<double>(outcome.cycles) / outcome.clock,
                              outcome.seconds / outcome.clock, outcome.clock));
    for (const auto& [text, cycle] : outcome.changes)
        line(cycle ? "changed" : "not changed", cycle ? fmt::format("in cycle {}, at {}", *cycle, text)
                                                      : fmt::format("at {}: it never was", text));
    if (loaded.world)
        for (std::size_t i = 0; i < loaded.world->bugs(); ++i) robot_summary(*loaded.world, i, line);
    if (!outcome.files.empty())
        line("written", fmt::format("{}: {}", o.directory, fmt::join(outcome.files, ", ")));
    return out;
}

}  // namespace forage::tool
