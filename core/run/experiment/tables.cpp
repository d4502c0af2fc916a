#include "core/run/experiment/tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"

namespace forage {
namespace {

/// A field of a CSV file (RFC 4180).
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

template <class T>
std::string field(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : "";
}

std::string row(const std::vector<std::string>& fields) {
    return fmt::format("{}\n", separated(fields, ","));
}

struct Statistics {
    std::size_t n = 0;
    double mean = 0, deviation = 0, least = 0, most = 0;
};

Statistics statistics(const std::vector<double>& values) {
    Statistics s;
    s.n = values.size();
    if (values.empty()) return s;
    for (const double v : values) s.mean += v;
    s.mean /= static_cast<double>(s.n);
    for (const double v : values) s.deviation += (v - s.mean) * (v - s.mean);
    s.deviation = s.n > 1 ? std::sqrt(s.deviation / static_cast<double>(s.n - 1)) : 0;
    const auto [least, most] = std::ranges::minmax_element(values);
    s.least = *least, s.most = *most;
    return s;
}

/// The runs of one combination of swept values, in order of the seeds.
struct Combination {
    std::vector<std::string> values;
    std::span<const RunResult> results;

    std::size_t finished() const {
        return static_cast<std::size_t>(
            std::ranges::count_if(results, [](const auto& r) { return r.failure.empty(); }));
    }
    Statistics of(std::size_t measure) const {
        std::vector<double> numbers;
        for (const auto& r : results)
            if (r.failure.empty() && r.measures[measure]) numbers.push_back(*r.measures[measure]);
        return statistics(numbers);
    }
};

std::vector<Combination> combinations(const RunPlan& plan, std::span<const RunResult> results) {
    std::vector<Combination> out;
    for (std::size_t c = 0; c < plan.combinations(); ++c)
        out.push_back({plan.values(c), results.subspan(plan.first(c), plan.seeds(c))});
    return out;
}

using observe::TableColumn;

bool have_trials(std::span<const RunResult> results) {
    return std::ranges::any_of(results, [](const auto& r) { return r.trials.has_value(); });
}

std::string status_of(const RunResult& r) {
    return !r.failure.empty() ? "failed" : r.stopped.empty() ? "finished" : "stopped";
}

const std::string& remark_of(const RunResult& r) {
    return !r.failure.empty() ? r.failure : r.stopped.empty() ? r.diverged : r.stopped;
}

/// The values of a sweep by combination: numbers if all of them are.
TableColumn swept_column(const model::Experiment& e, const RunPlan& plan, std::size_t sweep) {
    std::vector<std::string> texts;
    std::vector<double> numbers;
    for (std::size_t c = 0; c < plan.combinations(); ++c) {
        texts.push_back(plan.values(c)[sweep]);
        if (const auto n = parse_number<double>(texts.back())) numbers.push_back(*n);
    }
    const auto& name = e.sweeps[sweep].parameter.text;
    if (numbers.size() == texts.size())
        return {name, TableColumn::Numbers(
                          [numbers, &plan](std::size_t run) { return numbers[plan.combination(run)]; })};
    return {name,
            TableColumn::Texts([texts, &plan](std::size_t run) { return texts[plan.combination(run)]; })};
}

}  // namespace

std::vector<observe::TableColumn> results_columns(const model::Experiment& e, const RunPlan& plan,
                                                  std::span<const RunResult> results) {
    std::vector<TableColumn> out;
    const auto add = [&](TableColumn column) {
        while (std::ranges::any_of(out, [&](const auto& c) { return c.name == column.name; }))
            column.name += '\'';
        out.push_back(std::move(column));
    };
    const auto counts = [&](const char* name, auto value) {
        add({name, TableColumn::Counts([results, value](std::size_t run) { return value(results[run]); })});
    };
    add({"run", TableColumn::Texts([&plan](std::size_t run) { return plan.name(run); })});
    for (std::size_t s = 0; s < e.sweeps.size(); ++s) add(swept_column(e, plan, s));
    add({"seed", TableColumn::Counts([&plan](std::size_t run) { return plan.seed(run); })});
    add({"status", TableColumn::Texts([results](std::size_t run) { return status_of(results[run]); })});
    counts("cycles", [](const RunResult& r) { return r.cycles; });
    add({"seconds", TableColumn::Numbers([results](std::size_t run) { return results[run].seconds; })});
    if (have_trials(results)) {
        counts("trials", [](const RunResult& r) { return r.trials.value_or(0); });
        counts("reached", [](const RunResult& r) { return r.reached.value_or(0); });
    }
    for (std::size_t m = 0; m < e.measures.size(); ++m)
        add({e.measures[m].name, TableColumn::Numbers([results, m](std::size_t run) {
                 const RunResult& r = results[run];
                 return r.failure.empty() ? r.measures[m].value_or(std::nan("")) : std::nan("");
             })});
    add({"remark", TableColumn::Texts([results](std::size_t run) { return remark_of(results[run]); })});
    return out;
}

std::string results_csv(const model::Experiment& e, const RunPlan& plan, std::span<const RunResult> results) {
    const bool trials = have_trials(results);
    std::vector<std::string> header = {"run"};
    for (const auto& s : e.sweeps) header.push_back(field(s.parameter.text));
    for (const char* name : {"seed", "status", "cycles", "seconds"}) header.emplace_back(name);
    if (trials) header.emplace_back("trials"), header.emplace_back("reached");
    for (const auto& m : e.measures) header.push_back(field(m.name));
    header.emplace_back("remark");
    std::string out = row(header);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const RunResult& r = results[i];
        const bool failed = !r.failure.empty();
        std::vector<std::string> fields = {plan.name(i)};
        for (const auto& value : plan.values(plan.combination(i))) fields.push_back(field(value));
        fields.push_back(fmt::format("{}", plan.seed(i)));
        fields.push_back(status_of(r));
        fields.push_back(failed ? "" : fmt::format("{}", r.cycles));
        fields.push_back(failed ? "" : fmt::format("{}", r.seconds));
        if (trials) fields.push_back(field(r.trials)), fields.push_back(field(r.reached));
        for (std::size_t m = 0; m < e.measures.size(); ++m)
            fields.push_back(failed ? "" : field(r.measures[m]));
        fields.push_back(field(remark_of(r)));
        out += row(fields);
    }
    return out;
}

std::string summary_csv(const model::Experiment& e, const RunPlan& plan, std::span<const RunResult> results) {
    auto header = collected(e.sweeps, [](const auto& s) { return field(s.parameter.text); });
    header.emplace_back("runs");
    for (const auto& m : e.measures)
        for (const char* what : {"mean", "sd", "min", "max", "runs"})
            header.push_back(field(fmt::format("{} {}", m.name, what)));
    std::string out = row(header);
    for (const auto& c : combinations(plan, results)) {
        auto fields = collected(c.values, [](const auto& value) { return field(value); });
        fields.push_back(fmt::format("{}", c.finished()));
        for (std::size_t m = 0; m < e.measures.size(); ++m) {
            const Statistics s = c.of(m);
            fields.push_back(s.n ? fmt::format("{}", s.mean) : "");
            fields.push_back(s.n > 1 ? fmt::format("{}", s.deviation) : "");
            fields.push_back(s.n ? fmt::format("{}", s.least) : "");
            fields.push_back(s.n ? fmt::format("{}", s.most) : "");
            fields.push_back(fmt::format("{}", s.n));
        }
        out += row(fields);
    }
    return out;
}

std::string divergence_summary(const RunPlan& plan, std::span<const RunResult> results) {
    const auto diverged = [](const RunResult& r) { return !r.diverged.empty(); };
    const auto first = std::ranges::find_if(results, diverged);
    if (first == results.end()) return {};
    const auto count = std::count_if(first, results.end(), diverged);
    const std::string name = plan.name(static_cast<std::size_t>(first - results.begin()));
    if (count == 1) return fmt::format("run '{}': {}", name, first->diverged);
    return fmt::format("{} of {} runs have numbers that are not finite; the first, '{}': {}", count,
                       plan.size(), name, first->diverged);
}

Diagnostics warnings_of(const RunPlan& plan, std::span<const RunResult> results) {
    struct Shared {
        std::string text, hint, run;
        int count = 0;
    };
    std::vector<Shared> all;
    for (std::size_t i = 0; i < results.size(); ++i)
        for (const auto& [text, hint] : results[i].warnings) {
            auto at = std::ranges::find(all, text, &Shared::text);
            if (at == all.end()) at = all.insert(at, {text, hint, plan.name(i)});
            ++at->count;
        }
    Diagnostics out;
    for (const auto& w : all)
        out.warning({},
                    w.count == 1
                        ? fmt::format("run '{}': {}", w.run, w.text)
                        : fmt::format("{} of {} runs, such as '{}': {}", w.count, plan.size(), w.run, w.text),
                    w.hint);
    return out;
}

std::vector<std::string> event_notes(std::span<const RunResult> results) {
    std::map<std::string, std::size_t> early, never;  // by condition, with the number of runs
    for (const auto& r : results) {
        if (!r.until.empty()) ++early[r.until];
        for (const auto& change : std::set(r.never.begin(), r.never.end())) ++never[change];
    }
    std::vector<std::string> out;
    for (const auto& [condition, count] : early)
        out.push_back(
            fmt::format("{} of {} runs ended early, because '{}' held", count, results.size(), condition));
    for (const auto& [change, count] : never)
        out.push_back(
            fmt::format("in {} of {} runs the change at '{}' never happened", count, results.size(), change));
    return out;
}

std::string summary_text(const model::Experiment& e, const RunPlan& plan,
                         std::span<const RunResult> results) {
    std::vector<std::vector<std::string>> table(1);
    for (const auto& s : e.sweeps) table[0].push_back(s.parameter.text);
    for (const auto& m : e.measures) table[0].push_back(m.name);
    table[0].emplace_back("runs");
    for (const auto& c : combinations(plan, results)) {
        auto& line = table.emplace_back(c.values);
        for (std::size_t m = 0; m < e.measures.size(); ++m) {
            const Statistics s = c.of(m);
            line.push_back(s.n == 0  ? "none"
                           : s.n > 1 ? plain_number(s.mean, 4) + " +- " + plain_number(s.deviation, 2)
                                     : plain_number(s.mean, 4));
            if (s.n && s.n < c.finished()) line.back() += fmt::format(" ({} of {})", s.n, c.finished());
        }
        line.push_back(fmt::format("{}", c.finished()));
    }
    std::string out;
    for (const auto& line : table) {
        std::string text;
        for (std::size_t column = 0; column < line.size(); ++column) {
            std::size_t width = 0;
            for (const auto& other : table) width = std::max(width, other[column].size());
            text += fmt::format("  {:<{}}", line[column], width);
        }
        out += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
    }
    return out;
}

}  // namespace forage
