// Results of runs as JSON, for result.json and the files of parts.
#pragma once

#include <nlohmann/json.hpp>

#include "core/run/experiment/result.h"

namespace forage {

template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json json_of(const RunResult& result);
/// The opposite of json_of(). Throws nlohmann::json::exception.
RunResult result_of(const nlohmann::ordered_json& json);

}  // namespace forage
