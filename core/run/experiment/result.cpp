#include "core/run/experiment/result.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/output_files.h"
#include "core/run/input_files.h"

namespace forage {
namespace {

using Json = nlohmann::ordered_json;

std::string path_of(const PlannedRun& run) { return run.spec.directory + "/result.json"; }

std::string content_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}
template <class T>
std::optional<T> or_empty(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

}  // namespace

std::string key_of(const PlannedRun& run, const model::Experiment& experiment) {
    const RunSpec& o = run.spec;
    Json key;
    key["forage"] = FORAGE_VERSION;
    key["files"] = run.files;
    key["seed"] = run.spec.input.seed;
    key["noise"] = o.input.noise;
    key["pace"] = or_null(o.input.real_time_factor);
    key["cycles"] = or_null(o.length.cycles), key["seconds"] = or_null(o.length.seconds),
    key["trials"] = or_null(o.length.trials);
    key["longest_trial"] = o.length.trial_timeout;
    key["until"] = o.length.until.text;
    for (const auto& each : o.input.settings) key["set"].push_back(each.text);
    for (const auto& each : o.input.robots) key["bind"].push_back(each.text);
    for (const auto& each : o.changes) key["at"].push_back(each.text());
    for (const auto& m : o.manipulations)
        key["manipulate"].push_back({static_cast<int>(m.mode), m.group.text, m.cells.text,
                                     m.patterns.empty() ? "" : file_digest(m.patterns.text), m.every, m.step,
                                     or_null(m.times), m.backwards, m.from.text, m.until.text});
    for (const auto& r : o.recordings) key["record"].push_back({r.column.text, r.every});
    for (const auto& each : o.plots) key["plot"].push_back(each.text);
    for (const auto& m : experiment.measures) {
        auto& measure = key["measure"].emplace_back(Json{static_cast<int>(m.kind), m.what.text});
        if (!m.of.empty()) measure.push_back(m.of.text);
    }
    return key.dump();
}

std::optional<RunResult> read_result(const PlannedRun& run, const std::string& key) {
    try {
        const auto json = Json::parse(content_of(path_of(run)));
        if (json.at("run").dump() != key) return std::nullopt;
        const auto& result = json.at("result");
        RunResult out;
        out.stopped = result.at("stopped"), out.cycles = result.at("cycles"),
        out.seconds = result.at("seconds");
        out.diverged = result.value("diverged", "");
        out.warnings = result.value("warnings", out.warnings);
        out.until = result.value("until", "");
        out.never = result.value("never", std::vector<std::string>());
        out.trials = or_empty<std::uint64_t>(result.at("trials"));
        out.reached = or_empty<std::uint64_t>(result.at("reached"));
        for (const auto& m : result.at("measures")) out.measures.push_back(or_empty<double>(m));
        return out;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;  // absent, or of another run: the run is repeated
    }
}

void forget_result(const PlannedRun& run) {
    const auto json = Json::parse(content_of(path_of(run)), nullptr, false);
    std::error_code ignored;
    std::filesystem::remove(path_of(run), ignored);
    if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) return;
    for (const auto& f : json["files"])
        if (f.is_string() && f.get<std::string>() == file_name(f.get<std::string>()))
            std::filesystem::remove(run.spec.directory + "/" + f.get<std::string>(), ignored);
}

void write_result(const PlannedRun& run, const std::string& key, const RunResult& result,
                  const std::vector<std::string>& files) {
    for (const auto& name : files) flush_to_disk(run.spec.directory + "/" + name);
    Json json;
    json["run"] = Json::parse(key);
    auto& r = json["result"];
    r["stopped"] = result.stopped, r["cycles"] = result.cycles, r["seconds"] = result.seconds;
    if (!result.diverged.empty()) r["diverged"] = result.diverged;
    if (!result.warnings.empty()) r["warnings"] = result.warnings;
    if (!result.until.empty()) r["until"] = result.until;
    if (!result.never.empty()) r["never"] = result.never;
    r["trials"] = or_null(result.trials), r["reached"] = or_null(result.reached);
    r["measures"] = Json::array();
    for (const auto& m : result.measures) r["measures"].push_back(or_null(m));
    json["files"] = files;
    write_durably(path_of(run), json.dump(2) + "\n");
}

}  // namespace forage
