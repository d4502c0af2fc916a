#include "core/run/experiment/result.h"

#include <filesystem>

#include "core/base/digest.h"
#include "core/base/file_bytes.h"
#include "core/base/output_files.h"
#include "core/run/experiment/result_json.h"

namespace forage {
namespace {

using Json = nlohmann::ordered_json;

std::string path_of(const PlannedRun& run) { return run.spec.directory + "/result.json"; }

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
    for (const auto& r : o.recordings) {
        auto& recording = key["record"].emplace_back(Json{r.column.text, r.every});
        if (!r.format.empty()) recording.push_back(r.format);
    }
    const bool formulas = std::ranges::any_of(
        experiment.measures, [](const auto& m) { return m.kind == model::Measure::Kind::formula; });
    for (const auto& each : o.plots) key["plot"].push_back(each.text);
    for (const auto& m : experiment.measures) {
        auto& measure = key["measure"].emplace_back(Json{static_cast<int>(m.kind), m.what.text});
        if (!m.of.empty()) measure.push_back(m.of.text);
        if (formulas) measure.push_back(m.name);  // which formulas use
    }
    return key.dump();
}

std::optional<RunResult> read_result(const PlannedRun& run, const std::string& key) {
    try {
        const auto json = Json::parse(file_bytes(path_of(run)));
        if (json.at("run").dump() != key) return std::nullopt;
        return result_of(json.at("result"));
    } catch (const Json::exception&) {
        return std::nullopt;  // absent, or of another run: the run is repeated
    }
}

void forget_result(const PlannedRun& run) {
    const auto json = Json::parse(file_bytes(path_of(run)), nullptr, false);
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
    json["result"] = json_of(result);
    json["files"] = files;
    write_durably(path_of(run), json.dump(2) + "\n");
}

}  // namespace forage
