// Patterns, arborizations, functions and topologies as JSON. docs/design/studio-protocol.md describes the
// members.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/model/system.h"

namespace forage::editing {

using nlohmann::json;

json json_of(const model::Pattern& pattern);
json json_of(const model::Arborization& arborization);
json json_of(const model::DistanceFunction& function);
json json_of(const model::Topology& topology);
json points_of(const std::vector<model::Point>& points);

// They throw InputError for a form that does not exist, and json::exception for members that are missing.
model::Pattern pattern_from(const json& form);
model::Arborization arborization_from(const json& form);
model::DistanceFunction function_from(const json& form);
model::Topology topology_from(const json& form);
std::vector<model::Point> points_from(const json& points);
/// A number of the page, which may have a fraction, as a whole one. Throws InputError when it is beyond
/// `most`.
int whole_from(const json& number, double most = 1e6);

}  // namespace forage::editing
