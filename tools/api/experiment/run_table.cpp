#include "tools/api/experiment/run_table.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_set>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/base/table.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

/// The names of the parameters that are `last` without their owners.
std::vector<std::string> full_names(const RunTable& table, const std::string& last) {
    std::vector<std::string> out;
    for (const auto& name : table.parameters)
        if (name.substr(name.rfind('.') + 1) == last) out.push_back(name);
    return out;
}

/// The name of a parameter without its owner, unless another one has the same.
std::string short_name(const RunTable& table, std::size_t parameter) {
    const std::string& name = table.parameters[parameter];
    const std::string out = name.substr(name.rfind('.') + 1);
    return full_names(table, out).size() == 1 ? out : name;
}

std::string joined(const std::vector<std::string>& values, const std::vector<std::size_t>& parameters) {
    return separated(collected(parameters, [&](std::size_t p) { return values[p]; }), ", ");
}

/// What some parameters have: the different values, in the order of the table.
Axis axis_of(const RunTable& table, const std::vector<std::size_t>& parameters, std::string name) {
    Axis out{parameters, std::move(name), {}};
    for (const auto& row : table.rows)
        if (const auto [at, added] =
                out.indices.try_emplace(joined(row.values, parameters), out.values.size());
            added)
            out.values.push_back(at->first);
    return out;
}

}  // namespace

bool holds_experiment(const std::string& directory) {
    return fs::exists(directory + "/results.csv") &&
           (fs::is_directory(directory + "/runs") || fs::is_directory(directory + "/parts"));
}

bool has_runs(const std::string& directory) {
    std::error_code none;
    const fs::directory_iterator first(directory + "/runs", none);
    return !none && first != fs::directory_iterator();
}

RunTable read_run_table(const std::string& directory) {
    const std::string path = directory + "/results.csv";
    TableReader in(open_file(path), path);
    RunTable out;
    if (!in.read_header()) in.require_whole(), in.refuse("it is empty");
    const std::vector<std::string> names(in.fields().begin(), in.fields().end());
    const auto seed = static_cast<std::size_t>(std::ranges::find(names, "seed") - names.begin());
    auto first = seed + 4;  // seed, status, cycles, seconds
    out.trials = names.size() > first && names[first] == "trials";
    if (out.trials) first += 2;
    if (names.size() <= first || names.front() != "run" || names.back() != "remark")
        in.refuse("this is not the table of an experiment");
    out.parameters.assign(names.begin() + 1, names.begin() + static_cast<std::ptrdiff_t>(seed));
    out.measures.assign(names.begin() + static_cast<std::ptrdiff_t>(first), names.end() - 1);
    while (in.next()) {
        const auto& fields = in.fields();
        auto& row = out.rows.emplace_back();
        row.run = fields[0], row.seed = fields[seed];
        row.values.assign(fields.begin() + 1, fields.begin() + static_cast<std::ptrdiff_t>(seed));
        for (std::size_t m = 0; m < out.measures.size(); ++m) {
            const auto field = fields[first + m];
            row.measures.push_back(field.empty() ? std::nullopt : std::optional(in.number(field)));
        }
    }
    in.require_whole();
    if (out.rows.empty()) in.refuse("it has no runs");
    return out;
}

void keep_runs(RunTable& table, const std::vector<std::string>& where, Diagnostics& diagnostics) {
    const std::size_t seed = table.parameters.size();  // the seed stands behind the parameters
    const auto value_of = [&](const RunTable::Row& row, std::size_t p) {
        return p == seed ? row.seed : row.values[p];
    };
    std::vector<std::pair<std::size_t, std::string>> wanted;
    std::vector<std::string> parts;
    for (const auto& text : where) {
        const auto equals = std::min(text.rfind('='), text.size());
        const std::string name = text.substr(0, equals),
                          value = text.substr(std::min(equals + 1, text.size()));
        std::size_t p = 0;
        while (p < seed && name != table.parameters[p] && name != short_name(table, p)) ++p;
        const auto meant = full_names(table, name);
        if (p == seed && meant.size() > 1) {
            diagnostics.error({}, fmt::format("--where '{}': '{}' is ambiguous", text, name),
                              fmt::format("name one of '{}'", separated(meant, "', '")));
            continue;
        }
        if (p == seed && name != "seed") {
            diagnostics.error({}, fmt::format("--where '{}': no parameter '{}' was swept", text, name),
                              fmt::format("there are '{}{}seed'", separated(table.parameters, "', '"),
                                          seed > 0 ? "', '" : ""));
            continue;
        }
        std::vector<std::string> values;
        std::unordered_set<std::string> known;
        for (const auto& row : table.rows)
            if (known.insert(value_of(row, p)).second) values.push_back(value_of(row, p));
        const auto number = parse_number<double>(value);
        const auto found = std::ranges::find_if(values, [&](const std::string& v) {
            return v == value || (number && parse_number<double>(v) == number);
        });
        if (found == values.end()) {
            diagnostics.error({}, fmt::format("--where '{}': no run has this value", text),
                              fmt::format("there are '{}'", separated(values, "', '")));
            continue;
        }
        wanted.emplace_back(p, *found);
        parts.push_back(fmt::format("{}={}", p == seed ? "seed" : short_name(table, p), *found));
    }
    if (diagnostics.failed()) return;
    table.part = separated(parts, ", ");
    std::erase_if(table.rows, [&](const RunTable::Row& row) {
        return !std::ranges::all_of(wanted, [&](const auto& w) {
            return std::ranges::any_of(wanted, [&](const auto& other) {
                return other.first == w.first && other.second == value_of(row, w.first);
            });
        });
    });
    if (table.rows.empty())
        diagnostics.error({}, fmt::format("no run has {}", table.part), "these values do not occur together");
}

std::vector<double> Condition::numbers(std::size_t measure) const {
    std::vector<double> out;
    for (const auto* r : rows)
        if (r->measures[measure]) out.push_back(*r->measures[measure]);
    return out;
}

std::vector<Condition> conditions_of(const RunTable& table) {
    std::vector<Condition> out;
    std::map<std::vector<std::string>, std::size_t> indices;
    for (const auto& row : table.rows) {
        const auto [at, added] = indices.try_emplace(row.values, out.size());
        if (added) out.push_back({row.values, {}});
        out[at->second].rows.push_back(&row);
    }
    return out;
}

std::size_t Axis::value_of(const Condition& condition) const {
    return indices.at(joined(condition.values, parameters));
}

std::vector<Axis> axes_of(const RunTable& table) {
    std::vector<Axis> out;
    for (std::size_t p = 0; p < table.parameters.size(); ++p) {
        Axis alone = axis_of(table, {p}, table.parameters[p]);
        if (alone.values.size() == 1) continue;
        if (!out.empty()) {  // sweeps that vary together stand one after the other
            Axis& last = out.back();
            auto parameters = last.parameters;
            parameters.push_back(p);
            Axis both = axis_of(table, parameters, last.name + ", " + table.parameters[p]);
            if (both.values.size() < last.values.size() * alone.values.size()) {
                last = std::move(both);
                continue;
            }
        }
        out.push_back(std::move(alone));
    }
    return out;
}

std::string name_of(const Condition& condition, const std::vector<Axis>& axes, const RunTable& table) {
    std::vector<std::string> parts;
    for (const auto& axis : axes)
        for (const std::size_t p : axis.parameters)
            parts.push_back(fmt::format("{} = {}", short_name(table, p), condition.values[p]));
    return separated(parts, ", ");
}

}  // namespace forage
