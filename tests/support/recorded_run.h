// Runs a system against a recorded trace and finds the first number that differs.
#pragma once

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "tests/support/recorded_cases.h"

namespace forage::test {

/// Values of one column in one cycle, as recorded.
struct ExpectedRow {
    std::uint64_t cycle;
    std::string process, group, state;
    std::vector<double> values;
};

inline std::vector<ExpectedRow> expected_rows(const std::filesystem::path& path) {
    std::vector<ExpectedRow> out;
    Rows rows(path);
    for (std::vector<std::string_view> f; rows.next(f);) {
        if (f.size() < 5) continue;
        ExpectedRow row{
            number<std::uint64_t>(f[0]), std::string(f[1]), std::string(f[2]), std::string(f[3]), {}};
        for (std::size_t i = 5; i < f.size(); ++i) row.values.push_back(number(f[i]));
        out.push_back(std::move(row));
    }
    return out;
}

inline std::string trimmed(std::string text) {
    while (text.ends_with(' ')) text.pop_back();
    return text;
}

/// The column that a row names, or an empty one.
inline ConstColumn find_column(const engine::Simulation& s, const ExpectedRow& row) {
    if (row.group.starts_with("@module:")) {
        for (int m = 0; m < std::ssize(s.layout().modules); ++m)
            for (int p = 0; p < static_cast<int>(s.layout().modules[m].ports.outputs.size()); ++p)
                if (s.layout().modules[m].process == trimmed(row.process) &&
                    s.layout().modules[m].ports.outputs[static_cast<std::size_t>(p)].port ==
                        row.group.substr(8))
                    return s.module_output(m, p);
        return {nullptr, 0};
    }
    const auto hash = row.group.rfind('#');
    for (int g = 0; g < std::ssize(s.layout().groups); ++g) {
        const std::string path = trimmed(row.process) + "/" + trimmed(row.group);
        if (s.layout().groups[g].path != path &&
            !(hash != std::string::npos && s.layout().groups[g].id == row.group.substr(hash + 1)))
            continue;
        if (row.state == "excIn") return s.input(g, InputKind::excitatory);
        if (row.state == "inhIn") return s.input(g, InputKind::inhibitory);
        if (row.state == "modIn") return s.input(g, InputKind::modulatory);
        const auto& states = s.layout().groups[g].type.states;
        for (std::size_t i = 0; i < states.size(); ++i)
            if (states[i].name == row.state) return s.state(g, static_cast<int>(i));
    }
    return {nullptr, 0};
}

/// The first difference of the column from the recording, with its place; empty when there is none.
inline std::string difference(ConstColumn ours, const ExpectedRow& row, double tolerance = 1e-12) {
    const std::string where = fmt::format("cycle {}, {}/{} {}", row.cycle, row.process, row.group, row.state);
    if (ours.size() != static_cast<Index>(row.values.size()))
        return fmt::format("{}: {} cells, recorded {}", where, ours.size(), row.values.size());
    for (Index i = 0; i < ours.size(); ++i)
        if (!same(ours[i], row.values[static_cast<std::size_t>(i)], tolerance))
            return fmt::format("{}, cell {}: {}, recorded {}", where, i, ours[i],
                               row.values[static_cast<std::size_t>(i)]);
    return {};
}

}  // namespace forage::test
