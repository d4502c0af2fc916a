#include "core/run/run_json.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace forage {
namespace {

using Json = nlohmann::ordered_json;

/// A file that a run has read, with its digest, which shows later changes.
Json input_file(const std::string& path) { return {{"file", path}, {"sha256", file_digest(path)}}; }

std::string base_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// The versions, files and settings that are needed to repeat the run.
Json settings_json(const RunSpec& o, const Run& run, const std::vector<std::string>& plugins,
                   const std::vector<std::pair<std::string, std::string>>& libraries) {
    Json json;
    json["forage"] = FORAGE_VERSION;
    json["libraries"]["Eigen"] =
        fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
    for (const auto& [name, version] : libraries) json["libraries"][name] = version;
    json["compiler"] = __VERSION__;
    json["system"] = input_file(o.input.system);
    json["system"]["name"] = run.system().name;
    json["system"]["cycles_per_second"] = model::cycles_per_second(run.system());
    for (const auto& path : o.input.more) json["more_systems"].push_back(input_file(path));
    if (const auto* environment = run.environment()) {
        json["world"] = input_file(o.input.world);
        json["world"]["seconds_per_cycle"] = environment->seconds_per_cycle();
        json["world"]["noise"] = o.input.noise;
        if (o.input.sensor_rates) json["world"]["sensor_rates"] = true;
        if (o.input.latency) json["world"]["latency"] = o.input.latency;
        if (o.input.game) json["world"]["game"] = true;
    }
    json["seed"] = o.input.seed;
    if (o.length.trials) json["trials"] = *o.length.trials, json["trial_timeout"] = o.length.trial_timeout;
    if (o.input.real_time_factor) json["real_time_factor"] = *o.input.real_time_factor;
    json["set"] = Json::array();
    for (const auto& setting : o.input.settings) json["set"].push_back(setting.text);
    for (const auto& binding : o.input.robots) json["robot"].push_back(binding.text);
    json["record"] = Json::array();
    for (const auto& r : o.recordings) json["record"].push_back(r.column.text);
    json["every"] = o.recordings.empty() ? 1 : o.recordings.front().every;
    if (o.record.from) json["record_from"] = o.record.from;
    if (o.record.until) json["record_until"] = *o.record.until;
    if (o.record.mean) json["record_mean"] = true;
    if (o.record.format != "csv") json["record_format"] = o.record.format;
    for (const auto& plot : o.plots) json["plot"].push_back(plot.text);
    for (const auto& path : plugins) json["plugins"].push_back(input_file(path));
    if (!o.input.replay.empty()) json["replay"] = input_file(o.input.replay);
    for (const auto& change : o.changes) json["schedule"].push_back(change.text());
    if (!o.length.until.empty()) json["until"] = o.length.until.text;
    for (const auto& m : o.manipulations) json[m.name_of(m.mode)].push_back(m.text);
    json["lenient"] = o.input.lenient;
    return json;
}

/// What the cells of a recorded group stand for.
Json cells_json(const CellNames& names) {
    return {{"columns", names.columns}, {"rows", names.rows}, {"column", names.column}, {"row", names.row}};
}
CellNames names_in(const Json& json) {
    return {json.value("columns", std::vector<std::string>()), json.value("rows", std::vector<std::string>()),
            json.value("column", ""), json.value("row", "")};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> run_attributes(
    const RunSpec& spec, const Run& run, const std::vector<std::string>& plugins,
    const std::vector<std::pair<std::string, std::string>>& libraries) {
    const auto json = settings_json(spec, run, plugins, libraries);
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& [key, value] : json.items())
        out.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    return out;
}

std::string run_json(const PreparedRun& p, const RunOutcome& outcome) {
    const Run& run = p.run;
    auto json = settings_json(p.spec, run, p.plugins, p.libraries);
    if (!p.spec.command.empty()) json["command"] = p.spec.command, json["inputs"] = p.inputs;
    if (const auto cycles = p.stop.cycles()) json["cycles"] = *cycles;
    auto& result = json["result"];
    result["cycles"] = run.cycle();
    result["seconds"] = run.seconds();
    if (!outcome.stopped.empty()) result["stopped"] = outcome.stopped;
    if (!run.divergence().empty()) result["diverged"] = run.divergence();
    if (!outcome.state.empty()) result["state"] = outcome.state;
    for (const auto& e : p.schedule->entries())
        result["changes"].push_back({{"at", e.text}, {"cycle", e.cycle ? Json(*e.cycle) : Json()}});
    if (p.remote)
        for (const auto& c : p.remote->executed())
            result["commands"].push_back({{"cycle", c.cycle}, {"command", c.text}});
    if (const auto* environment = run.environment()) {
        const auto names = environment->robot_names();
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto measured = run.trials(i);
            const auto& trials = measured.finished;
            auto& robot = result["robots"].emplace_back();
            robot["name"] = names[i];
            robot["trials"] = trials.size();
            robot["at_target"] = measured.reached();
            if (!trials.empty()) robot["recent_success"] = measured.recent_success(trials.size());
        }
        for (const auto& score : environment->scores())
            result["score"].push_back(
                {{"team", score.team}, {"points", score.points}, {"good", score.good}, {"bad", score.bad}});
    }
    for (std::size_t g = 0; g < run.layout().groups.size(); ++g)
        if (run.simulation().pruned(static_cast<int>(g)))
            result["pruned"].push_back(run.layout().groups[g].path);
    result["files"] = outcome.files.names();
    for (const auto& r : outcome.files.recordings()) {
        auto& entry = result["recordings"].emplace_back();
        entry = {{"file", r.file}, {"source", r.source}, {"label", r.label}};
        if (r.names.any()) entry["cells"] = cells_json(r.names);
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<FinishedRun> read_run_json(const std::string& directory) {
    std::ifstream in(directory + "/run.json");
    if (!in) return std::nullopt;
    try {
        const auto json = Json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
        FinishedRun out;
        const auto none = Json::object();
        const auto& system = json.at("system");
        const auto world = json.value("world", none);
        const auto& result = json.at("result");
        out.input.system = system.at("file");
        for (const auto& more : json.value("more_systems", Json::array()))
            out.input.more.push_back(more.at("file"));
        out.input.world = world.value("file", "");
        out.input.seed = json.at("seed");
        for (const auto& s : json.value("set", Json::array()))
            out.input.settings.push_back({s.get<std::string>()});
        for (const auto& binding : json.value("robot", Json::array()))
            out.input.robots.push_back({binding.get<std::string>()});
        out.input.lenient = json.value("lenient", false);
        out.command = json.value("command", std::vector<std::string>());
        out.inputs = json.value("inputs", InputFiles());
        const double rate = system.value("cycles_per_second", 0.0);
        out.seconds_per_cycle = world.value("seconds_per_cycle", rate > 0 ? 1 / rate : 0);
        for (const auto& f : result.value("files", Json::array()))
            if (f.get<std::string>() == file_name(f.get<std::string>())) out.files.push_back(f);
        for (const auto& r : result.value("recordings", Json::array()))
            out.recordings.push_back(
                {r.at("file"), r.at("source"), r.at("label"), names_in(r.value("cells", none))});
        for (const auto& [key, value] : json.items())
            if (key != "libraries" && key != "compiler" && key != "command" && key != "inputs" &&
                key != "result")
                out.settings.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
        return out;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

std::string run_title(const RunInput& input) {
    std::string systems = base_name(input.system);
    for (const auto& path : input.more) systems += " and " + base_name(path);
    return fmt::format("{}{}, seed {}", systems, input.world.empty() ? "" : " in " + base_name(input.world),
                       input.seed);
}

}  // namespace forage
