#include "tools/studio/server/equivalents.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/types/parameter.h"

namespace forage::studio {
namespace {

/// A word for the shell.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text)
        if (c == '\'')
            out += "'\\''";
        else
            out += c;
    return out + "'";
}

/// A string of Python.
std::string literal(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string value_in_python(const std::string& text) {
    if (text == "true") return "True";
    if (text == "false") return "False";
    return parse_parameter(ParameterKind::real, text) ? text : literal(text);
}

}  // namespace

Equivalent of_assignments(const std::vector<std::string>& assignments, std::uint64_t cycle) {
    Equivalent out;
    for (const std::string& a : assignments) {
        const auto equal = a.find('=');
        const std::string name = a.substr(0, equal), value = equal == a.npos ? "" : a.substr(equal + 1);
        if (!out.shell.empty()) out.shell += ' ', out.python += '\n';
        out.shell +=
            cycle == 0 ? "--set " + quoted(a) : "--schedule " + quoted(fmt::format("cycle {}: {}", cycle, a));
        out.python += fmt::format("run.params[{}] = {}", literal(name), value_in_python(value));
    }
    return out;
}

Equivalent of_manipulation(const std::string& group, const std::string& mode,
                           const std::vector<std::vector<double>>& patterns, int width, std::uint64_t every,
                           std::uint64_t cycle) {
    const std::string from = cycle > 0 ? fmt::format("; from cycle {}", cycle) : "";
    const std::string pace = every > 1 ? fmt::format("; every {}", every) : "";
    std::string what = group + "=patterns.txt";
    const double neutral = mode == "multiply" ? 1 : 0;
    if (patterns.size() == 1) {
        const auto& p = patterns.front();
        std::string cells;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (p[i] != neutral)
                cells += fmt::format("{}({},{})={}", cells.empty() ? "" : " ",
                                     i % static_cast<std::size_t>(width) + 1,
                                     i / static_cast<std::size_t>(width) + 1, p[i]);
        if (std::ranges::all_of(p, [&](double v) { return v == p.front(); }))
            what = fmt::format("{}={}", group, p.front());
        else if (cells.size() < 200)
            what = group + cells;
    }
    std::vector<std::string> rows;
    for (const auto& p : patterns) {
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < p.size(); i += static_cast<std::size_t>(width))
            lines.push_back(
                fmt::format("[{}]", fmt::join(p.begin() + static_cast<std::ptrdiff_t>(i),
                                              p.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                              p.size(), i + static_cast<std::size_t>(width))),
                                              ", ")));
        rows.push_back(fmt::format("[{}]", fmt::join(lines, ", ")));
    }
    const std::string values = rows.size() == 1 ? rows[0] : fmt::format("[{}]", fmt::join(rows, ", "));
    return {fmt::format("--{} {}", mode, quoted(what + pace + from)),
            fmt::format("run[{}].{}({}{})", literal(group), mode, values,
                        every > 1 ? fmt::format(", every={}", every) : "")};
}

}  // namespace forage::studio
