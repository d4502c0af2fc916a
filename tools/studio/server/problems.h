// Problems of a command as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "core/base/diagnostic.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {

using nlohmann::json;

/// The diagnostics as a list of objects with severity, file, line, column, message and hint.
inline json problems_of(const Diagnostics& diagnostics) {
    json out = json::array();
    for (const auto& d : diagnostics.all()) {
        const bool quotes = (d.message + d.hint).find_first_of("<'") != std::string::npos;
        const bool hidden = quotes && d.where.file && !may_quote(*d.where.file);
        out.push_back({{"severity", d.severity == Severity::error ? "error" : "warning"},
                       {"file", d.where.file ? d.where.file->path : ""},
                       {"line", d.where.line},
                       {"column", d.where.column},
                       {"message", hidden ? "this is not a file of the kind that belongs here" : d.message},
                       {"hint", hidden ? "" : d.hint}});
    }
    return out;
}

/// One error without a place.
inline json problem(const std::string& message, const std::string& hint = {}) {
    Diagnostics one;
    one.error({}, message, hint);
    return problems_of(one);
}

}  // namespace forage::studio
