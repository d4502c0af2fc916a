// Experiment files -> model.
#pragma once

#include <optional>
#include <string>

#include "core/model/experiment.h"

namespace forage::xml {

/// Reads an experiment file and reports every problem of its form. What stands in its attributes in languages
/// of their own (conditions, assignments, columns) is the business of those who know the system.
std::optional<model::Experiment> read_experiment(const std::string& path, Diagnostics& diagnostics);
/// The same of a text that a person knows as `path`.
std::optional<model::Experiment> parse_experiment(std::string path, std::string text,
                                                  Diagnostics& diagnostics);

}  // namespace forage::xml
