#include "tools/api/experiment_plots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/number.h"
#include "core/base/table.h"
#include "tools/plot/heat.h"
#include "tools/plot/lines.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using plot::PlotSpec;

constexpr std::size_t most_lines = 10;   ///< that can be told apart
constexpr std::size_t most_blocks = 25;  ///< of trials, in a picture of learning

/// Rows with the same values of the parameters, in the order of the table.
struct Combination {
    std::vector<std::string> values;
    std::vector<const RunTable::Row*> rows;

    std::vector<double> of(std::size_t measure) const {
        std::vector<double> out;
        for (const auto* r : rows)
            if (r->measures[measure]) out.push_back(*r->measures[measure]);
        return out;
    }
};

std::vector<Combination> combinations(const RunTable& table) {
    std::vector<Combination> out;
    for (const auto& row : table.rows) {
        auto at = std::find_if(out.begin(), out.end(), [&](const auto& c) { return c.values == row.values; });
        if (at == out.end()) at = out.insert(out.end(), {row.values, {}});
        at->rows.push_back(&row);
    }
    return out;
}

/// The different values of a parameter, in the order of the table.
std::vector<std::string> values_of(const std::vector<Combination>& all, std::size_t parameter) {
    std::vector<std::string> out;
    for (const auto& c : all)
        if (std::find(out.begin(), out.end(), c.values[parameter]) == out.end())
            out.push_back(c.values[parameter]);
    return out;
}

/// The number of parameters that vary on their own: those that vary together with the first one count once.
std::size_t dimensions(const std::vector<Combination>& all, std::size_t parameters) {
    std::size_t product = 1, out = 0;
    for (std::size_t p = 0; p < parameters && product < all.size(); ++p)
        product *= values_of(all, p).size(), ++out;
    return out;
}

/// Places of values on an axis: the numbers themselves, their logarithms when they span more than a factor
/// of 30, or 0, 1, 2... for texts.
std::vector<double> places_of(const std::vector<std::string>& values) {
    std::vector<double> numbers, order;
    for (const auto& v : values) {
        order.push_back(static_cast<double>(order.size()));
        if (const auto n = parse_number<double>(v)) numbers.push_back(*n);
    }
    if (numbers.size() < values.size()) return order;
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    if (*least > 0 && *most > 30 * *least)
        for (double& n : numbers) n = std::log10(n);
    return numbers;
}

/// The name of a parameter without its owner, unless another one has the same.
std::string short_name(const RunTable& table, std::size_t parameter) {
    const auto last = [](const std::string& name) { return name.substr(name.rfind('.') + 1); };
    const std::string out = last(table.parameters[parameter]);
    const auto same = std::count_if(table.parameters.begin(), table.parameters.end(),
                                    [&](const std::string& other) { return last(other) == out; });
    return same == 1 ? out : table.parameters[parameter];
}

std::string named(const RunTable& table, const std::vector<std::string>& values, std::size_t from) {
    std::vector<std::string> parts;
    for (std::size_t i = from; i < values.size(); ++i)
        parts.push_back(fmt::format("{} = {}", short_name(table, i), values[i]));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string runs_each(const std::vector<Combination>& all) {
    std::size_t most = 0;
    for (const auto& c : all) most = std::max(most, c.rows.size());
    return most > 1 ? fmt::format("means of {} runs with their 95 % intervals", most) : "one run each";
}

plot::Picture curve(const RunTable& table, std::size_t measure, const std::string& title) {
    const auto all = combinations(table);
    const auto values = values_of(all, 0);
    const auto places = places_of(values);
    plot::LinesPlot out{title, runs_each(all), table.parameters[0], table.measures[measure], {}, {}};
    for (std::size_t i = 0; i < values.size(); ++i) out.x_ticks.emplace_back(places[i], values[i]);
    const bool together = dimensions(all, table.parameters.size()) == 1;  // other parameters make no lines
    if (together && table.parameters.size() > 1)
        out.x_title = fmt::format("{}", fmt::join(table.parameters, ", "));
    for (std::size_t i = 0; together && i < all.size(); ++i)
        out.x_ticks[i].second = fmt::format("{}", fmt::join(all[i].values, ", "));
    for (const auto& c : all) {
        const std::string name = together ? "" : named(table, c.values, 1);
        auto line =
            std::find_if(out.lines.begin(), out.lines.end(), [&](const auto& l) { return l.name == name; });
        if (line == out.lines.end()) line = out.lines.insert(out.lines.end(), {name, {}});
        const auto i = std::find(values.begin(), values.end(), c.values[0]) - values.begin();
        if (const auto y = plot::estimate(c.of(measure)))
            line->points.push_back({places[static_cast<std::size_t>(i)], *y});
    }
    for (auto& line : out.lines)
        std::sort(line.points.begin(), line.points.end(),
                  [](const auto& a, const auto& b) { return a.x < b.x; });
    std::sort(out.x_ticks.begin(), out.x_ticks.end());
    return plot::lines_plot(out);
}

plot::Picture heat(const RunTable& table, std::size_t measure, const std::string& title) {
    const auto all = combinations(table);
    plot::HeatMap out{title,
                      runs_each(all),
                      table.measures[measure],
                      table.parameters[0],
                      table.parameters[1],
                      values_of(all, 0),
                      values_of(all, 1),
                      {}};
    out.numbers.assign(out.x_names.size() * out.y_names.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& c : all) {
        const auto at = [&](const std::vector<std::string>& names, const std::string& value) {
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), value) - names.begin());
        };
        if (const auto mean = plot::estimate(c.of(measure)))
            out.numbers[at(out.y_names, c.values[1]) * out.x_names.size() + at(out.x_names, c.values[0])] =
                mean->mean;
    }
    if (all.front().rows.size() > 1) out.subtitle = fmt::format("means of {} runs", all.front().rows.size());
    return plot::heat_map(out);
}

/// The numbers of a run's finished trials: a column of trials.csv, or 1 for a target and 0 for a miss.
std::vector<std::optional<double>> numbers_of_trials(const std::string& directory,
                                                     const std::string& column) {
    const std::string path = directory + "/trials.csv";
    TableReader trials(open_file(path), path);
    if (!trials.read_header()) trials.require_whole(), trials.refuse("it is empty");
    const auto outcome = trials.column("outcome");
    const auto wanted = column.empty() ? outcome : trials.column(column);
    std::vector<std::optional<double>> out;
    while (trials.next()) {
        const auto& fields = trials.fields();
        if (fields[outcome] == "unfinished") continue;
        if (column.empty())
            out.emplace_back(fields[outcome] == "target" ? 1 : 0);
        else
            out.push_back(fields[wanted].empty() ? std::nullopt
                                                 : std::optional(trials.number(fields[wanted])));
    }
    trials.require_whole();
    return out;
}

}  // namespace

bool holds_experiment(const std::string& directory) {
    return fs::exists(directory + "/results.csv") && fs::is_directory(directory + "/runs");
}

RunTable read_run_table(const std::string& directory) {
    const std::string path = directory + "/results.csv";
    TableReader in(open_file(path), path);
    RunTable out;
    if (!in.read_header()) in.require_whole(), in.refuse("it is empty");
    const std::vector<std::string> names(in.fields().begin(), in.fields().end());
    const auto seed = static_cast<std::size_t>(std::find(names.begin(), names.end(), "seed") - names.begin());
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
        row.run = fields[0];
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

std::vector<std::string> usual_plots(const RunTable& table, const std::string& directory) {
    std::vector<std::string> out;
    const auto all = combinations(table);
    const auto n = dimensions(all, table.parameters.size());
    for (const auto& m : table.measures)
        if (all.size() > 1) out.push_back((n == 2 && table.parameters.size() == 2 ? "heat:" : "curve:") + m);
    const auto any = [&](const char* file) {
        return std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
            return fs::exists(fmt::format("{}/runs/{}/{}", directory, row.run, file));
        });
    };
    if (table.trials && any("trials.csv") && all.size() <= most_lines) out.emplace_back("learning");
    if (any("trajectory.csv")) out.emplace_back("occupancy");
    return out;
}

std::optional<plot::Picture> draw_measure(const PlotSpec& spec, const RunTable& table,
                                          const std::string& title, Diagnostics& diagnostics) {
    const auto found = std::find(table.measures.begin(), table.measures.end(), spec.what);
    const int errors_before = diagnostics.errors();
    const auto n = table.parameters.size();
    const bool as_heat = spec.kind == PlotSpec::Kind::heat;
    if (found == table.measures.end())
        diagnostics.error({}, fmt::format("'{}': there is no measure '{}'", spec.text, spec.what),
                          fmt::format("the experiment has '{}'", fmt::join(table.measures, "', '")));
    else if (n == 0)
        diagnostics.error({}, fmt::format("'{}': this experiment sweeps no parameter", spec.text),
                          "'learning' and 'occupancy' need no parameter");
    else if (as_heat && n != 2)
        diagnostics.error(
            {}, fmt::format("'{}': a heat map needs two swept parameters, and there are {}", spec.text, n),
            fmt::format("use 'curve:{}'", spec.what));
    if (diagnostics.errors() > errors_before) return std::nullopt;
    const auto measure = static_cast<std::size_t>(found - table.measures.begin());
    return as_heat ? heat(table, measure, title) : curve(table, measure, title);
}

std::vector<TrialSeries> trial_series(const RunTable& table, const std::string& directory) {
    std::vector<TrialSeries> out;
    for (const auto& c : combinations(table)) {
        auto& series = out.emplace_back();
        series.name = named(table, c.values, 0);
        for (const auto* row : c.rows) series.directories.push_back(directory + "/runs/" + row->run);
    }
    return out;
}

std::optional<plot::Picture> draw_learning(const PlotSpec& spec, const std::vector<TrialSeries>& series,
                                           const std::string& title, Diagnostics& diagnostics) {
    if (series.size() > most_lines) {
        diagnostics.error(
            {}, fmt::format("'{}': {} combinations are too many for a picture", spec.text, series.size()),
            "draw a run: forage plot DIR/runs/NAME learning");
        return std::nullopt;
    }
    std::vector<std::vector<std::vector<std::optional<double>>>> trials;  // by series, run, trial
    std::size_t longest = 0, runs = 0;
    for (const auto& s : series) {
        auto& all = trials.emplace_back();
        for (const auto& directory : s.directories) {
            if (!fs::exists(directory + "/trials.csv")) continue;  // the run failed
            all.push_back(numbers_of_trials(directory, spec.what));
            longest = std::max(longest, all.back().size());
        }
        runs = std::max(runs, all.size());
    }
    if (longest == 0) {
        diagnostics.error({}, fmt::format("'{}': there are no finished trials", spec.text),
                          "a world that puts its robot back to the start has trials");
        return std::nullopt;
    }
    const std::size_t block = (longest + most_blocks - 1) / most_blocks;
    plot::LinesPlot out{
        title,
        fmt::format("{} of {}", block > 1 ? fmt::format("blocks of {} trials", block) : "trials",
                    runs > 1 ? fmt::format("{} runs, with their 95 % intervals", runs) : "one run"),
        "trial",
        spec.what.empty() ? "share of trials at the target" : spec.what,
        {},
        {}};
    for (std::size_t s = 0; s < series.size(); ++s) {
        auto& line = out.lines.emplace_back();
        line.name = series[s].name;
        for (std::size_t first = 0; first < longest; first += block) {
            std::vector<double> means;
            for (const auto& run : trials[s]) {
                std::vector<double> numbers;
                for (std::size_t t = first; t < std::min(first + block, run.size()); ++t)
                    if (run[t]) numbers.push_back(*run[t]);
                if (const auto mean = plot::estimate(numbers)) means.push_back(mean->mean);
            }
            const auto last = std::min(first + block, longest);
            auto y = plot::estimate(means);
            if (!y) continue;
            if (spec.what.empty())
                y->low = std::max(y->low, 0.0), y->high = std::min(y->high, 1.0);  // a share
            line.points.push_back({static_cast<double>(first + last + 1) / 2, *y});
        }
    }
    return plot::lines_plot(out);
}

}  // namespace forage
