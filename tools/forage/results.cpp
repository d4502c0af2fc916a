#include "tools/forage/results.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bug_interface/versions.h"
#include "tools/forage/cores.h"
#include "tools/forage/files.h"
#include "tools/forage/input_files.h"
#include "tools/forage/score.h"
#include "tools/plot/film.h"

namespace forage::tool {
namespace {

/// A file that a run has read, with a digest (64-bit FNV-1a) that tells whether it has changed since.
nlohmann::ordered_json input_file(const std::string& path) {
    return {{"file", path}, {"fnv1a64", file_digest(path)}};
}

std::string base_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Versions, files and settings: what is needed to repeat the run.
nlohmann::ordered_json settings_json(const RunOptions& o, const Loaded& loaded) {
    nlohmann::ordered_json json;
    json["forage"] = FORAGE_VERSION;
    json["libraries"]["Eigen"] =
        fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
    for (const auto& [name, version] : bug::library_versions()) json["libraries"][name] = version;
    json["compiler"] = __VERSION__;
    json["system"] = input_file(o.input.system);
    json["system"]["name"] = loaded.system.name;
    json["system"]["cycles_per_second"] = cycles_per_second(loaded.system);
    for (const auto& path : o.input.more) json["more_systems"].push_back(input_file(path));
    if (loaded.world) {
        json["world"] = input_file(o.input.world);
        json["world"]["seconds_per_cycle"] = loaded.world->seconds_per_cycle();
        json["world"]["noise"] = o.input.noise;
        if (o.input.sensor_rates) json["world"]["sensor_rates"] = true;
        if (o.input.latency) json["world"]["latency"] = o.input.latency;
        if (o.input.game) json["world"]["game"] = true;
    }
    json["seed"] = o.input.seed;
    if (o.trials) json["trials"] = *o.trials, json["longest_trial"] = o.longest_trial;
    if (o.input.world_pace) json["world_pace"] = *o.input.world_pace;
    json["set"] = nlohmann::ordered_json::array();
    for (const auto& wish : o.input.settings) json["set"].push_back(wish.text);
    json["record"] = nlohmann::ordered_json::array();
    for (const auto& r : o.recordings) json["record"].push_back(r.column.text);
    json["every"] = o.recordings.empty() ? 1 : o.recordings.front().every;
    if (o.record.from) json["record_from"] = o.record.from;
    if (o.record.until) json["record_until"] = *o.record.until;
    if (o.record.mean) json["record_mean"] = true;
    if (o.record.format != "csv") json["record_format"] = o.record.format;
    for (const auto& wish : o.plots) json["plot"].push_back(wish.text);
    for (const auto& path : loaded.plugins) json["plugins"].push_back(input_file(path));
    if (!o.input.drive.empty()) json["drive"] = input_file(o.input.drive);
    for (const auto& wish : o.at) json["at"].push_back(wish.text());
    if (!o.until.empty()) json["until"] = o.until.text;
    if (!o.clamp.empty()) json["clamp"] = o.clamp;
    for (const auto& m : o.manipulations)
        json[std::array{"clamp", "add", "multiply"}[static_cast<std::size_t>(m.mode)]].push_back(m.text);
    json["lenient"] = o.input.lenient;
    return json;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> run_attributes(const RunOptions& o, const Loaded& loaded) {
    const auto json = settings_json(o, loaded);
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& [key, value] : json.items())
        out.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    return out;
}

std::string run_json(const RunOptions& o, const Loaded& loaded, const Outcome& outcome) {
    auto json = settings_json(o, loaded);
    if (outcome.length) json["cycles"] = *outcome.length;
    auto& result = json["result"];
    result["cycles"] = outcome.cycles;
    result["seconds"] = outcome.seconds;
    if (!outcome.stopped.empty()) result["stopped"] = outcome.stopped;
    if (!outcome.diverged.empty()) result["diverged"] = outcome.diverged;
    if (!outcome.state.empty()) result["state"] = outcome.state;
    for (const auto& [text, cycle] : outcome.changes)
        result["changes"].push_back(
            {{"at", text}, {"cycle", cycle ? nlohmann::ordered_json(*cycle) : nlohmann::ordered_json()}});
    if (loaded.world)
        for (std::size_t i = 0; i < loaded.world->bugs(); ++i) {
            const Trials& trials = outcome.trials[i];
            auto& robot = result["robots"].emplace_back();
            robot["name"] = loaded.world->robot_names()[i];
            robot["trials"] = trials.finished.size();
            robot["at_target"] = trials.reached();
            if (!trials.finished.empty())
                robot["recent_success"] = trials.recent_success(trials.finished.size());
        }
    if (loaded.world && !loaded.world->game().empty())
        for (int team = 0; team < 2; ++team) {
            const auto& game = loaded.world->game();
            result["score"].push_back({{"team", team_name(team)},
                                       {"points", game.points(team)},
                                       {"good", game.delivered(team, true)},
                                       {"bad", game.delivered(team, false)}});
        }
    if (!outcome.pruned.empty()) result["pruned"] = outcome.pruned;
    result["files"] = outcome.files;
    for (const auto& r : outcome.recordings)
        result["recordings"].push_back({{"file", r.file}, {"source", r.source}, {"label", r.label}});
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<std::string> files_of_last_run(const std::string& directory) {
    std::vector<std::string> out;
    if (!std::filesystem::is_regular_file(directory + "/run.json")) return out;
    std::ifstream in(directory + "/run.json");
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.contains("forage") || !json.contains("result")) return out;
    const auto files = json["result"].value("files", nlohmann::json::array());
    for (const auto& f : files)
        if (f.is_string() && f.get<std::string>() == file_name(f.get<std::string>())) out.push_back(f);
    return out;
}

std::string picture_title(const RunOptions& o, const Loaded& loaded) {
    std::string systems = base_name(o.input.system);
    for (const auto& path : o.input.more) systems += " and " + base_name(path);
    return fmt::format("{}{}, seed {}", systems, loaded.world ? " in " + base_name(o.input.world) : "",
                       o.input.seed);
}

std::string summary(const RunOptions& o, const Loaded& loaded, const Outcome& outcome) {
    std::string out = picture_title(o, loaded) + "\n";
    const auto line = [&](std::string_view name, const std::string& text) {
        out += fmt::format("  {:<14} {}\n", name, text);
    };
    if (!outcome.stopped.empty()) line("stopped", outcome.stopped);
    line("cycles", fmt::format("{} ({:.1f} s {})", outcome.cycles, outcome.seconds,
                               loaded.world ? "in the world" : "at the system's pace"));
    const auto done = static_cast<double>(outcome.cycles - outcome.first_cycle);
    line("speed", fmt::format("{:.0f} cycles/s, {:.0f} x real time ({:.2f} s)", done / outcome.clock,
                              outcome.seconds * done / (static_cast<double>(outcome.cycles) * outcome.clock),
                              outcome.clock));
    if (o.threads > 1 && cores() == 1)
        line("threads", fmt::format("1 of {}: there is one core", o.threads));
    else if (o.threads > 1 && outcome.shared_cycles == 0)
        line("threads", fmt::format("1 of {}: cycles are too short to share, or too few to try", o.threads));
    else if (o.threads > 1)
        line("threads",
             fmt::format(
                 "{}, which shared {:.1f} % of the cycles; in the others, by trials, one thread is as fast",
                 o.threads > cores() ? fmt::format("{} of {}, one per core", cores(), o.threads)
                                     : fmt::format("{}", o.threads),
                 100 * static_cast<double>(outcome.shared_cycles) / done));
    for (const auto& [text, cycle] : outcome.changes)
        line(cycle ? "changed" : "not changed", cycle ? fmt::format("in cycle {}, at {}", *cycle, text)
                                                      : fmt::format("at {}: it never was", text));
    if (loaded.world)
        for (std::size_t i = 0; i < loaded.world->bugs(); ++i) {
            const std::string name = loaded.world->bugs() > 1 ? loaded.world->robot_names()[i] + " " : "";
            for (const auto& [what, text] : trials_summary(*loaded.world, outcome.trials[i]))
                line(name + what, text);
        }
    if (loaded.world && !loaded.world->game().empty()) out += score_table(loaded.world->game());
    if (outcome.frames)
        line("film", o.video.ends_with(".gif")
                         ? fmt::format("{}: {} frames", o.video, outcome.frames)
                         : fmt::format("{} to {}", plot::Film::frame_name(o.video, 1),
                                       plot::Film::frame_name(o.video, outcome.frames)));
    if (!outcome.pruned.empty())
        line("pruned", fmt::format("{} of {} groups, which nothing reads; --hash computes all",
                                   outcome.pruned.size(), outcome.groups));
    if (o.hash) line("computed", fmt::format("all {} groups, as --hash demands", outcome.groups));
    if (!outcome.diverged.empty()) line("diverged", outcome.diverged);
    if (!outcome.state.empty()) line("state", outcome.state);
    if (outcome.resumable) line("to go on", "forage resume " + o.directory);
    if (!outcome.files.empty())
        line("written", fmt::format("{}: {}", o.directory, fmt::join(outcome.files, ", ")));
    return out;
}

}  // namespace forage::tool
