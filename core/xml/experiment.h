// Reads experiment files into models.
#pragma once

#include <optional>
#include <string>

#include "core/model/experiment.h"

namespace forage::xml {

/// Reads an experiment file and reports every problem of its form. Expressions in its attributes (conditions,
/// assignments, sources) are checked later, against the system.
std::optional<model::Experiment> read_experiment(const std::string& path, Diagnostics& diagnostics);
/// Reads the text of an experiment file; messages call it `path`.
std::optional<model::Experiment> parse_experiment(std::string path, std::string text,
                                                  Diagnostics& diagnostics);

}  // namespace forage::xml
