// The original's files of plots (.conf) as layouts for a page.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/run/run.h"

namespace forage::studio {

/// The windows of a file with the name `path`, as panels of a page: {"plots": [{"kind", "item", ...}],
/// "problems": [...]}, with warnings about what is left out. Throws InputError for a text that cannot be
/// read.
nlohmann::json plot_layout(const Run& run, const std::string& path, const std::string& text);

}  // namespace forage::studio
