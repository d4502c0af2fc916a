// The rounds of adaptive experiments: which runs follow from which results.
#include "core/run/experiment/rounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/base/estimate.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

using Counts = std::vector<std::size_t>;

model::Experiment experiment_of(model::Adaptation adaptation, std::size_t values, std::size_t seeds) {
    model::Experiment e;
    e.systems = {{"a.iqr"}};
    e.seeds.clear();
    for (std::size_t s = 0; s < seeds; ++s) e.seeds.push_back(s + 1);
    auto& sweep = e.sweeps.emplace_back();
    sweep.parameter = {"P/A.eta"};
    for (std::size_t v = 0; v < values; ++v) sweep.values.push_back({std::to_string(v)});
    e.measures.resize(2);
    e.measures[0].name = "other", e.measures[1].name = "score";
    adaptation.measure = {"score"};
    e.adaptation = adaptation;
    return e;
}

using Score = std::function<std::optional<double>(std::size_t combination, std::uint64_t seed)>;

std::optional<RunResult> result_of(std::optional<double> score) {
    RunResult out;
    out.measures = {0, score};
    return out;
}

/// The seeds of each combination in all rounds.
std::vector<Counts> rounds_of(const model::Experiment& e, const Score& score) {
    RunPlan plan(e, "out");
    std::vector<std::optional<RunResult>> results(plan.size());
    std::vector<Counts> out;
    for (;;) {
        for (std::size_t i = 0; i < plan.size(); ++i) {
            const std::uint64_t mark = 1000 * plan.combination(i) + plan.seed(i);
            if (results[i]) REQUIRE(results[i]->cycles == mark);  // it was carried over to its place
            results[i] = result_of(score(plan.combination(i), plan.seed(i)));
            results[i]->cycles = mark;
        }
        auto& counts = out.emplace_back();
        for (std::size_t c = 0; c < plan.combinations(); ++c) counts.push_back(plan.seeds(c));
        const auto next = next_round(e, plan, results);
        if (!next) return out;
        RunPlan later = plan.with_seeds(*next);
        results = carry_over(plan, std::move(results), later);
        REQUIRE(results.size() == later.size());
        plan = std::move(later);
    }
}

/// A number from -1 to 1.
double noise(std::size_t combination, std::uint64_t seed) {
    return static_cast<double>((combination * 7919 + seed * 104729) % 2001) / 1000 - 1;
}

model::Adaptation until_width(double width, std::uint64_t most = 100) {
    model::Adaptation out;
    out.width = width, out.most = most;
    return out;
}

model::Adaptation halving(bool highest = true) {
    model::Adaptation out;
    out.kind = model::Adaptation::Kind::halving, out.lowest = !highest;
    return out;
}

}  // namespace

TEST_CASE("A plan whose combinations have different numbers of seeds") {
    auto e = experiment_of(halving(), 3, 2);
    e.seeds = {7, 3};
    const RunPlan plan = RunPlan(e, "out").with_seeds({2, 4, 3});
    REQUIRE(plan.size() == 9);
    CHECK(plan.combinations() == 3);
    std::vector<std::uint64_t> seeds;
    Counts combinations;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        seeds.push_back(plan.seed(i)), combinations.push_back(plan.combination(i));
        CHECK(plan[i].name ==
              "eta-" + std::to_string(plan.combination(i)) + "_seed-" + std::to_string(plan.seed(i)));
        CHECK(plan[i].values == plan.values(plan.combination(i)));
        CHECK(plan[i].spec.input.seed == plan.seed(i));
    }
    CHECK(seeds == std::vector<std::uint64_t>{7, 3, 7, 3, 8, 9, 7, 3, 8});  // more seeds follow the largest
    CHECK(combinations == Counts{0, 0, 1, 1, 1, 1, 2, 2, 2});
    CHECK(plan.first(1) == 2);
    CHECK(plan.seeds(1) == 4);
}

TEST_CASE("Seeds are added until the interval of the mean is narrow enough, combination by combination") {
    // Noise of three amplitudes; the first is narrow at once.
    const double amplitudes[] = {0.01, 0.5, 1};
    const Score score = [&](std::size_t c, std::uint64_t seed) { return 5 + amplitudes[c] * noise(c, seed); };
    const auto rounds = rounds_of(experiment_of(until_width(0.4), 3, 4), score);
    REQUIRE(rounds.size() > 2);
    CHECK(rounds.front() == Counts{4, 4, 4});
    const auto& last = rounds.back();
    CHECK(last[0] == 4);
    CHECK(last[1] > 4);
    CHECK(last[2] > last[1]);
    CHECK(last[2] < 100);
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> numbers;
        for (std::uint64_t s = 1; s <= last[c]; ++s) numbers.push_back(*score(c, s));
        const auto e = *estimate(numbers);
        CHECK(e.high - e.low <= 0.4);
    }
    for (std::size_t r = 1; r < rounds.size(); ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(rounds[r][c] >= rounds[r - 1][c]);
            CHECK(rounds[r][c] <= 2 * rounds[r - 1][c]);
        }
}

TEST_CASE("A width may be a share of the mean, and the number of seeds has a maximum") {
    const Score score = [](std::size_t c, std::uint64_t seed) {
        return (c == 0 ? 1 : -100) + noise(c, seed);
    };
    model::Adaptation a;
    a.relative_width = 0.05, a.most = 50;
    CHECK(rounds_of(experiment_of(a, 2, 3), score).back() == Counts{50, 3});
    CHECK(rounds_of(experiment_of(until_width(0, 11), 2, 3), score).back() == Counts{11, 11});
}

TEST_CASE("Runs without a number do not make an interval narrow") {
    const auto none = [](std::size_t c, std::uint64_t seed) -> std::optional<double> {
        if (c == 0) return std::nullopt;
        if (c == 1) return NAN;
        if (c == 2) return INFINITY;
        return seed % 2 ? std::optional(1.0) : std::nullopt;
    };
    CHECK(rounds_of(experiment_of(until_width(0.1, 20), 4, 2), none) ==
          std::vector<Counts>{{2, 2, 2, 2}, {4, 4, 4, 4}, {8, 8, 8, 4}, {16, 16, 16, 4}, {20, 20, 20, 4}});
}

TEST_CASE("Halving keeps the better half and doubles its seeds until two are left") {
    const Score score = [](std::size_t c, std::uint64_t seed) {
        return static_cast<double>((c * 3) % 7) + 0.1 * noise(c, seed);  // 0 3 6 2 5 1 4
    };
    CHECK(rounds_of(experiment_of(halving(), 7, 2), score) ==
          std::vector<Counts>{{2, 2, 2, 2, 2, 2, 2}, {2, 4, 4, 2, 4, 2, 4}, {2, 4, 8, 2, 8, 2, 4}});
    CHECK(rounds_of(experiment_of(halving(false), 7, 1), score).back() == Counts{4, 2, 1, 2, 1, 4, 1});
    CHECK(rounds_of(experiment_of(halving(), 2, 3), score).size() == 1);
    CHECK(rounds_of(experiment_of(halving(), 1, 3), score).size() == 1);
}

TEST_CASE("Of equal combinations halving keeps the first, and those without finite numbers are the worst") {
    const Score equal = [](std::size_t, std::uint64_t) { return 1.0; };
    CHECK(rounds_of(experiment_of(halving(), 4, 1), equal).back() == Counts{2, 2, 1, 1});
    const auto broken = [](std::size_t c, std::uint64_t) -> std::optional<double> {
        if (c == 0) return std::nullopt;
        return c == 1 ? NAN : c == 2 ? INFINITY : -1000;
    };
    for (const bool highest : {true, false})
        CHECK(rounds_of(experiment_of(halving(highest), 4, 1), broken).back()[3] == 2);
}

TEST_CASE("No round is decided before all results of the last one are there") {
    const auto e = experiment_of(halving(), 4, 2);
    const RunPlan plan(e, "out");
    std::vector<std::optional<RunResult>> results;
    for (std::size_t i = 0; i < plan.size(); ++i) results.push_back(result_of(noise(i / 2, i % 2)));
    CHECK(next_round(e, plan, results));
    auto missing = results;
    missing[5].reset();
    CHECK_FALSE(next_round(e, plan, missing));
    auto plain = e;
    plain.adaptation.reset();
    CHECK_FALSE(next_round(plain, plan, results));
    // A failed run has no number, and does not stand in the way.
    RunResult failure;
    failure.failure = "the disk is full";
    results[5] = failure;
    CHECK(next_round(e, plan, results));
}

TEST_CASE("The interval of an experiment that stops when it is narrow holds the mean a little less often") {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto coverage = [&](std::size_t begin) {
        const std::size_t experiments = 4000;
        std::vector<double> numbers(300);
        const auto e = experiment_of(until_width(1, numbers.size()), experiments, begin);
        std::vector<std::vector<double>> all(experiments, numbers);
        for (auto& each : all) std::generate(each.begin(), each.end(), [&] { return normal(random); });
        const auto seeds = rounds_of(e, [&](std::size_t c, std::uint64_t s) { return all[c][s - 1]; }).back();
        int held = 0;
        for (std::size_t c = 0; c < experiments; ++c) {
            all[c].resize(seeds[c]);
            const auto found = *estimate(all[c]);
            held += found.low <= 0 && 0 <= found.high;
        }
        return static_cast<double>(held) / experiments;
    };
    // docs/how-to/adaptive.md says so
    CHECK(coverage(2) == Approx(0.89).margin(0.011));
    CHECK(coverage(5) == Approx(0.92).margin(0.011));
    CHECK(coverage(10) == Approx(0.94).margin(0.011));
}

TEST_CASE("What the rounds have found is said in a sentence") {
    auto e = experiment_of(halving(), 2, 2);
    const RunPlan plan(e, "out");
    std::vector<RunResult> results;
    for (const double score : {1.0, 2.0, 2.5, 3.5}) results.push_back(*result_of(score));
    CHECK(adaptation_note(e, plan, results) == "the highest 'score', 3, is that of P/A.eta = 1");
    e = experiment_of(until_width(14), 2, 2);  // 2 * 12.706 * 0.5 = 12.7
    CHECK(adaptation_note(e, plan, results) ==
          "the interval of 'score' is narrow enough in 2 of 2 combinations");
    e.adaptation.reset();
    CHECK(adaptation_note(e, plan, results).empty());
}
