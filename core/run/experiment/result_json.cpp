#include "core/run/experiment/result_json.h"

#include <cmath>
#include <limits>

namespace forage {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::optional<T> or_empty(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

/// JSON has no NaN and no infinity, so they are texts.
Json number(const std::optional<double>& value) {
    if (!value || std::isfinite(*value)) return or_null(value);
    return std::isnan(*value) ? "nan" : *value > 0 ? "inf" : "-inf";
}
std::optional<double> number(const Json& json) {
    if (!json.is_string()) return or_empty<double>(json);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto text = json.get<std::string>();
    return text == "inf" ? infinity : text == "-inf" ? -infinity : std::nan("");
}

}  // namespace

Json json_of(const RunResult& result) {
    Json r;
    if (!result.failure.empty()) r["failure"] = result.failure;
    r["stopped"] = result.stopped, r["cycles"] = result.cycles, r["seconds"] = result.seconds;
    if (!result.diverged.empty()) r["diverged"] = result.diverged;
    if (!result.warnings.empty()) r["warnings"] = result.warnings;
    if (!result.until.empty()) r["until"] = result.until;
    if (!result.never.empty()) r["never"] = result.never;
    r["trials"] = or_null(result.trials), r["reached"] = or_null(result.reached);
    r["measures"] = Json::array();
    for (const auto& m : result.measures) r["measures"].push_back(number(m));
    return r;
}

RunResult result_of(const Json& json) {
    RunResult out;
    out.failure = json.value("failure", "");
    out.stopped = json.at("stopped"), out.cycles = json.at("cycles"), out.seconds = json.at("seconds");
    out.diverged = json.value("diverged", "");
    out.warnings = json.value("warnings", out.warnings);
    out.until = json.value("until", "");
    out.never = json.value("never", std::vector<std::string>());
    out.trials = or_empty<std::uint64_t>(json.at("trials"));
    out.reached = or_empty<std::uint64_t>(json.at("reached"));
    for (const auto& m : json.at("measures")) out.measures.push_back(number(m));
    return out;
}

}  // namespace forage
