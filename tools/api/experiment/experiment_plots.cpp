#include "tools/api/experiment/experiment_plots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include "core/base/hit_counts.h"
#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/table.h"
#include "core/run/result_names.h"
#include "tools/plot/heat.h"
#include "tools/plot/lines.h"
#include "tools/plot/occupancy.h"

namespace forage {
namespace {

namespace fs = std::filesystem;
using plot::PlotSpec;

constexpr std::size_t max_lines = 10;  ///< that readers can distinguish
constexpr std::size_t unreadable_lines = 100;
constexpr std::size_t max_blocks = 25;  ///< of trials, in a picture of learning

/// Places of values on an axis, and whether they are logarithms. On a logarithmic axis, 0 is at the left, and
/// the axis is broken at `gap`.
struct Places {
    std::vector<double> at;
    bool logarithmic = false;
    std::optional<double> gap = {};
};

/// The numbers themselves, their logarithms when those above 0 span more than a factor of 30 and none is
/// below 0, or 0, 1, 2... for texts and for parameters that vary together.
Places places_of(const Axis& axis) {
    std::vector<double> numbers, order;
    for (const auto& v : axis.values) {
        order.push_back(static_cast<double>(order.size()));
        if (const auto n = parse_number<double>(v)) numbers.push_back(*n);
    }
    if (numbers.size() < order.size()) return {order};
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const double n : numbers)
        if (n > 0) least = std::min(least, n), most = std::max(most, n);
    const bool zero = std::ranges::find(numbers, 0.0) != numbers.end();
    if (most <= 30 * least || *std::ranges::min_element(numbers) < 0) return {numbers};
    const double low = std::log10(least), aside = 0.18 * (std::log10(most) - low);
    for (double& n : numbers) n = n > 0 ? std::log10(n) : low - aside;
    return {numbers, true, zero ? std::optional(low - aside / 2) : std::nullopt};
}

std::size_t index_of(const std::vector<std::string>& values, const std::string& value) {
    return static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
}

/// "threshold = 0.2; means of 2 to 3 runs", from the part of the table and the estimates in a picture.
std::string subtitle_of(const std::string& part, const std::vector<std::optional<Estimate>>& estimates) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max(), most = 0;
    for (const auto& e : estimates)
        if (e) fewest = std::min(fewest, e->count), most = std::max(most, e->count);
    return fmt::format("{}{}{}", part, part.empty() ? "" : "; ",
                       most == 1        ? "one run each"
                       : fewest == most ? fmt::format("means of {} runs", most)
                                        : fmt::format("means of {} to {} runs", fewest, most));
}

std::string with_intervals(const std::string& subtitle) {
    return subtitle.ends_with("one run each") ? subtitle : subtitle + ", with their 95 % intervals";
}

/// The number of lines in a curve over the first axis.
std::size_t lines_of(const std::vector<Axis>& axes) {
    std::size_t out = 1;
    for (std::size_t a = 1; a < axes.size(); ++a) out *= axes[a].values.size();
    return out;
}

plot::Picture curve(const RunTable& table, const std::vector<Axis>& axes, std::size_t measure,
                    const std::string& title) {
    const Axis& x = axes.front();
    const auto places = places_of(x);
    plot::LinesPlot out{
        title, {},        x.name + (places.logarithmic ? " (logarithmic)" : ""), table.measures[measure], {},
        {},    places.gap};
    for (std::size_t i = 0; i < x.values.size(); ++i) out.x_ticks.emplace_back(places.at[i], x.values[i]);
    std::vector<std::optional<Estimate>> estimates;
    const std::vector<Axis> others(axes.begin() + 1, axes.end());
    std::unordered_map<std::string, std::size_t> lines;
    for (const auto& c : conditions_of(table)) {
        const std::string name = name_of(c, others, table);
        const auto [line, added] = lines.try_emplace(name, out.lines.size());
        if (added) out.lines.push_back({name, {}});
        estimates.push_back(estimate(c.numbers(measure)));
        out.lines[line->second].points.push_back({places.at[x.value_of(c)], estimates.back()});
    }
    for (auto& line : out.lines) std::ranges::sort(line.points, {}, &plot::LinesPlot::Point::x);
    std::ranges::sort(out.x_ticks);
    out.subtitle = with_intervals(subtitle_of(table.part, estimates));
    return plot::lines_plot(out);
}

plot::Picture heat(const RunTable& table, const std::vector<Axis>& axes, std::size_t measure,
                   const std::string& title) {
    const Axis &x = axes[0], &y = axes[1];
    plot::HeatMap out{title, {}, table.measures[measure], x.name, y.name, x.values, y.values, {}};
    out.cells.resize(x.values.size() * y.values.size());
    for (const auto& c : conditions_of(table))
        out.cells[y.value_of(c) * x.values.size() + x.value_of(c)] = estimate(c.numbers(measure));
    out.subtitle = subtitle_of(table.part, out.cells);
    return plot::heat_map(out);
}

bool has_numbers(const RunTable& table, std::size_t measure) {
    return std::ranges::any_of(table.rows,
                               [&](const auto& row) { return row.measures[measure].has_value(); });
}

using Numbers = std::vector<std::optional<double>>;

/// The numbers of the finished trials by run: a column of trials.csv, or 1 for a target and 0 for a miss. In
/// the table of a single run, its name is empty.
std::unordered_map<std::string, Numbers> numbers_of_trials(const std::string& path,
                                                           const std::string& column) {
    TableReader trials(open_file(path), path);
    if (!trials.read_header()) trials.require_whole(), trials.refuse("it is empty");
    const auto outcome = trials.column("outcome");
    const auto wanted = column.empty() ? outcome : trials.column(column);
    const bool several = trials.fields().front() == "run";
    std::unordered_map<std::string, Numbers> out;
    while (trials.next()) {
        const auto& fields = trials.fields();
        if (fields[outcome] == "unfinished") continue;
        Numbers& numbers = out[several ? std::string(fields.front()) : ""];
        if (column.empty())
            numbers.emplace_back(fields[outcome] == "target" ? 1 : 0);
        else
            numbers.push_back(fields[wanted].empty() ? std::nullopt
                                                     : std::optional(trials.number(fields[wanted])));
    }
    trials.require_whole();
    return out;
}

/// The share of targets among the last trials, after each of them.
plot::LinesPlot::Line running_share(const Numbers& outcomes) {
    plot::LinesPlot::Line out;
    HitCounts hits;
    for (const auto& outcome : outcomes) {
        hits.add(*outcome == 1);
        auto y = hits.learned(hits.size());
        y.count = 1;  // no runs are missing
        out.points.push_back({static_cast<double>(hits.size()), y});
    }
    return out;
}

}  // namespace

std::vector<std::string> usual_plots(const RunTable& table, const std::string& directory) {
    std::vector<std::string> out;
    const auto axes = axes_of(table);
    for (std::size_t m = 0; m < table.measures.size(); ++m)
        if (!axes.empty() && has_numbers(table, m))
            out.push_back((axes.size() == 2 ? "heat:" : "curve:") + table.measures[m]);
    const auto conditions = conditions_of(table).size();
    const bool runs = has_runs(directory);
    const auto any = [&](const std::string& file) {
        return runs && std::ranges::any_of(table.rows, [&](const auto& row) {
                   return fs::exists(fmt::format("{}/runs/{}/{}", directory, row.run, file));
               });
    };
    if (table.trials && conditions <= max_lines &&
        (fs::exists(directory + "/" + trials_file()) || any(trials_file())))
        out.emplace_back("learning");
    if (conditions <= plot::max_maps && any(trajectory_file())) out.emplace_back("occupancy");
    return out;
}

std::optional<plot::Picture> draw_measure(const PlotSpec& spec, const RunTable& table,
                                          const std::string& title, Diagnostics& diagnostics) {
    const auto measure = index_of(table.measures, spec.what);
    const auto axes = axes_of(table);
    std::vector<std::string> names;
    for (const auto& axis : axes) names.push_back(axis.name);
    const bool as_heat = spec.kind == PlotSpec::Kind::heat;
    const auto example_of = [&](const Axis& axis) {
        const std::size_t p = axis.parameters.front();
        return fmt::format("{}={}", table.parameters[p], table.rows.front().values[p]);
    };
    const auto refuse = [&](const std::string& why, const std::string& hint) {
        diagnostics.error({}, fmt::format("'{}': {}", spec.text, why), hint);
        return std::nullopt;
    };
    if (measure == table.measures.size())
        return refuse(fmt::format("there is no measure '{}'", spec.what),
                      fmt::format("the experiment has '{}'", separated(table.measures, "', '")));
    if (axes.empty())
        return refuse("no parameter varies among these runs", "'learning' and 'occupancy' need no parameter");
    if (!has_numbers(table, measure))
        return refuse("no run has a number", "the column 'remark' of results.csv may say why");
    if (as_heat && axes.size() == 1)
        return refuse(fmt::format("a heat map needs two parameters, and only '{}' varies", names.front()),
                      fmt::format("use 'curve:{}'", spec.what));
    if (as_heat && axes.size() > 2)
        return refuse(fmt::format("a heat map has two parameters, and here {} vary: '{}'", axes.size(),
                                  separated(names, "', '")),
                      fmt::format("fix the others: --where '{}'", example_of(axes[2])));
    if (!as_heat && lines_of(axes) > unreadable_lines)
        return refuse(fmt::format("{} lines are too many for a picture", lines_of(axes)),
                      fmt::format("draw a part: --where '{}'", example_of(axes[1])));
    if (!as_heat && lines_of(axes) > max_lines)
        diagnostics.warning(
            {}, fmt::format("'{}' has {} lines in {} colours", spec.text, lines_of(axes), max_lines),
            fmt::format("draw a part: --where '{}'", example_of(axes[1])));
    return as_heat ? heat(table, axes, measure, title) : curve(table, axes, measure, title);
}

std::vector<RunSeries> run_series(const RunTable& table, const std::string& directory) {
    std::vector<RunSeries> out;
    for (const auto& c : conditions_of(table)) {
        auto& series = out.emplace_back();
        series.name = name_of(c, axes_of(table), table);
        for (const auto* row : c.rows) series.directories.push_back(directory + "/runs/" + row->run);
    }
    return out;
}

std::optional<plot::Picture> draw_learning(const PlotSpec& spec, const std::vector<RunSeries>& series,
                                           const std::string& table, const std::string& title,
                                           const std::string& part, Diagnostics& diagnostics) {
    if (series.size() > max_lines) {
        diagnostics.error(
            {}, fmt::format("'{}': {} conditions are too many for a picture", spec.text, series.size()),
            "draw some of them, with --where 'PARAMETER=VALUE'");
        return std::nullopt;
    }
    const bool together = fs::exists(table);
    std::unordered_map<std::string, Numbers> by_run;
    if (together) by_run = numbers_of_trials(table, spec.what);
    std::vector<std::vector<Numbers>> trials;  // by series, run, trial
    std::size_t longest = 0;
    for (const auto& s : series) {
        auto& all = trials.emplace_back();
        for (const auto& directory : s.directories) {
            if (!together && !fs::exists(directory + "/" + trials_file())) continue;  // the run failed
            all.push_back(together ? by_run[fs::path(directory).filename().string()]
                                   : numbers_of_trials(directory + "/" + trials_file(), spec.what)[""]);
            longest = std::max(longest, all.back().size());
        }
    }
    if (longest == 0) {
        diagnostics.error({}, fmt::format("'{}': there are no finished trials", spec.text),
                          "a world that puts its robot back to the start has trials");
        return std::nullopt;
    }
    const std::size_t block = (longest + max_blocks - 1) / max_blocks;
    plot::LinesPlot out{title, {}, "trial", spec.what.empty() ? "share of trials at the target" : spec.what,
                        {},    {}, {}};
    if (spec.what.empty() && trials.size() == 1 && trials.front().size() == 1) {
        out.subtitle = fmt::format("{}{}mean of the last {} trials, or of all so far, with its 95 % interval",
                                   part, part.empty() ? "" : "; ", learning_window);
        out.lines = {running_share(trials.front().front())};
        return plot::lines_plot(out);
    }
    std::vector<std::optional<Estimate>> estimates;
    for (std::size_t s = 0; s < series.size(); ++s) {
        auto& line = out.lines.emplace_back();
        line.name = series[s].name;
        std::size_t own = 0;  // a line ends with the longest run of its condition
        for (const auto& run : trials[s]) own = std::max(own, run.size());
        for (std::size_t first = 0; first < own; first += block) {
            std::vector<double> means;
            for (const auto& run : trials[s]) {
                std::vector<double> numbers;
                for (std::size_t t = first; t < std::min(first + block, run.size()); ++t)
                    if (run[t]) numbers.push_back(*run[t]);
                if (const auto mean = estimate(numbers)) means.push_back(mean->mean);
            }
            const auto last = std::min(first + block, longest);
            auto y = estimate(means);
            if (y && spec.what.empty())
                y->low = std::max(y->low, 0.0), y->high = std::min(y->high, 1.0);  // a share
            line.points.push_back({static_cast<double>(first + last + 1) / 2, y});
            estimates.push_back(y);
        }
    }
    if (std::ranges::none_of(estimates, [](const auto& e) { return e.has_value(); })) {
        diagnostics.error({}, fmt::format("'{}': no trial has a number", spec.text),
                          "docs/reference/results.md says when a column of trials.csv is empty");
        return std::nullopt;
    }
    out.subtitle = with_intervals(subtitle_of(part, estimates));
    if (block > 1) out.subtitle += fmt::format("; blocks of {} trials", block);
    return plot::lines_plot(out);
}

}  // namespace forage
