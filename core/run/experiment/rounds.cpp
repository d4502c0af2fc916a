#include "core/run/experiment/rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/estimate.h"
#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"

namespace forage {
namespace {

const RunResult& result_in(const RunResult& result) { return result; }
const RunResult& result_in(const std::optional<RunResult>& result) { return *result; }

/// The numbers that a combination's runs have for the measure that decides, in the order of the seeds.
template <class Results>
std::vector<double> numbers_of(const model::Experiment& e, const RunPlan& plan, const Results& results,
                               std::size_t combination) {
    const auto measure = static_cast<std::size_t>(
        std::ranges::find_if(e.measures,
                             [&](const auto& m) { return m.name == e.adaptation->measure.text; }) -
        e.measures.begin());
    std::vector<double> out;
    for (std::size_t run = plan.first(combination); run < plan.first(combination + 1); ++run) {
        const RunResult& result = result_in(results[run]);
        if (result.failure.empty() && result.measures[measure]) out.push_back(*result.measures[measure]);
    }
    return out;
}

bool narrow(const model::Adaptation& a, double mean, double width) {
    return a.width ? width <= *a.width : width <= *a.relative_width * std::abs(mean);
}
bool narrow(const model::Adaptation& a, const std::vector<double>& numbers) {
    const auto e = estimate(numbers);
    return e && e->count > 1 && narrow(a, e->mean, e->high - e->low);
}

/// As many seeds as the deviation of the numbers suggests, but at most twice as many as there are, because
/// the deviation of few numbers is uncertain.
std::size_t more_seeds(const model::Adaptation& a, const std::vector<double>& numbers, std::size_t seeds) {
    if (seeds >= a.most || narrow(a, numbers)) return seeds;
    const std::size_t last = std::min<std::size_t>(2 * seeds, a.most), missing = seeds - numbers.size();
    if (numbers.size() < 2) return last;
    double mean = 0, squares = 0;
    for (const double v : numbers) mean += v / static_cast<double>(numbers.size());
    for (const double v : numbers) squares += (v - mean) * (v - mean);
    const double variance = squares / static_cast<double>(numbers.size() - 1);
    std::size_t out = seeds + 1;
    while (out < last && !narrow(a, mean, 2 * half_width(variance, out - missing))) ++out;
    return out;
}

/// The combinations with most seeds, which are those of the last round of halving, the best one first.
template <class Results>
std::vector<std::size_t> ranking(const model::Experiment& e, const RunPlan& plan, const Results& results) {
    std::size_t most = 0;
    for (std::size_t c = 0; c < plan.combinations(); ++c) most = std::max(most, plan.seeds(c));
    std::vector<std::pair<double, std::size_t>> all;  // what is small comes first
    for (std::size_t c = 0; c < plan.combinations(); ++c) {
        if (plan.seeds(c) < most) continue;
        const auto found = estimate(numbers_of(e, plan, results, c));
        const double mean = found ? found->mean : std::nan("");
        const double good = e.adaptation->lowest ? mean : -mean;
        all.emplace_back(std::isfinite(good) ? good : std::numeric_limits<double>::infinity(), c);
    }
    std::ranges::sort(all);  // of equal ones, the first in the plan
    return collected(all, [](const auto& ranked) { return ranked.second; });
}

}  // namespace

std::optional<std::vector<std::size_t>> next_round(const model::Experiment& e, const RunPlan& plan,
                                                   std::span<const std::optional<RunResult>> results) {
    if (!e.adaptation || std::ranges::any_of(results, [](const auto& r) { return !r; })) return std::nullopt;
    std::vector<std::size_t> seeds(plan.combinations());
    for (std::size_t c = 0; c < seeds.size(); ++c) seeds[c] = plan.seeds(c);
    const auto before = seeds;
    if (e.adaptation->kind == model::Adaptation::Kind::confidence) {
        for (std::size_t c = 0; c < seeds.size(); ++c)
            seeds[c] = more_seeds(*e.adaptation, numbers_of(e, plan, results, c), seeds[c]);
    } else {
        const auto ranked = ranking(e, plan, results);
        const std::size_t kept = (ranked.size() + 1) / 2;
        for (std::size_t i = 0; kept > 1 && i < kept; ++i) seeds[ranked[i]] *= 2;
    }
    if (seeds == before) return std::nullopt;
    return seeds;
}

std::vector<std::optional<RunResult>> carry_over(const RunPlan& plan,
                                                 std::vector<std::optional<RunResult>> results,
                                                 const RunPlan& later) {
    std::vector<std::optional<RunResult>> out(later.size());
    for (std::size_t c = 0; c < plan.combinations(); ++c)
        std::move(results.begin() + static_cast<std::ptrdiff_t>(plan.first(c)),
                  results.begin() + static_cast<std::ptrdiff_t>(plan.first(c + 1)),
                  out.begin() + static_cast<std::ptrdiff_t>(later.first(c)));
    return out;
}

std::string adaptation_note(const model::Experiment& e, const RunPlan& plan,
                            std::span<const RunResult> results) {
    if (!e.adaptation) return {};
    const auto& a = *e.adaptation;
    if (a.kind == model::Adaptation::Kind::halving) {
        const std::size_t best = ranking(e, plan, results).front();
        std::vector<std::string> values;
        for (std::size_t i = 0; i < e.sweeps.size(); ++i)
            values.push_back(fmt::format("{} = {}", e.sweeps[i].parameter.text, plan.values(best)[i]));
        const auto found = estimate(numbers_of(e, plan, results, best));
        return fmt::format("the {} '{}', {}, is that of {}", a.lowest ? "lowest" : "highest", a.measure.text,
                           found ? plain_number(found->mean, 4) : "none", separated(values, ", "));
    }
    std::size_t enough = 0;
    for (std::size_t c = 0; c < plan.combinations(); ++c)
        enough += narrow(a, numbers_of(e, plan, results, c));
    return fmt::format("the interval of '{}' is narrow enough in {} of {} combinations", a.measure.text,
                       enough, plan.combinations());
}

}  // namespace forage
