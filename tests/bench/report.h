// The output of benchmarks, for readers and for programs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <time.h>

namespace forage::bench {

/// Appends a result to the file that $FORAGE_BENCH_JSON names, one JSON object per line; does nothing without
/// it. `tools/bench` collects them. `subject`: what was measured, `metric`: which of its figures.
inline void result(std::string_view subject, std::string_view metric, double value, std::string_view unit) {
    const char* file = std::getenv("FORAGE_BENCH_JSON");
    if (!file) return;
    std::ofstream(file, std::ios::app)
        << nlohmann::json{{"subject", subject}, {"metric", metric}, {"value", value}, {"unit", unit}}.dump()
        << '\n';
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The processor time of this thread, s. Other load of the machine affects it less than wall-clock time.
inline double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double wall_seconds() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Runs per second, block by block. Comparisons within one run use the best block, because other load on the
/// same processor does not slow all blocks. The median is what a user of this machine would see.
struct Rates {
    std::vector<double> blocks;
    double best() const { return *std::max_element(blocks.begin(), blocks.end()); }
    double median() const { return bench::median(blocks); }
};

/// Adds `count` blocks that last this many seconds or somewhat longer, by either clock.
template <class Run>
void add_rates(Rates& rates, double (*clock)(), int count, Run run, double seconds_of_block = 0.025) {
    for (long runs = 1; count > 0;) {
        const double begin = clock();
        for (long i = 0; i < runs; ++i) run();
        const double seconds = clock() - begin;
        if (seconds < seconds_of_block && runs < 100'000'000)
            runs *= 2;
        else
            rates.blocks.push_back(static_cast<double>(runs) / seconds), --count;
    }
}

template <class Run>
Rates rates(double (*clock)(), Run run) {
    Rates out;
    add_rates(out, clock, 21, run);
    return out;
}

/// Measures several kinds of runs in turns, so that other load of the machine affects all of them.
template <class... Runs>
std::array<Rates, sizeof...(Runs)> rates_in_turns(double (*clock)(), Runs... runs) {
    constexpr int turns = 10, blocks = 5;
    std::array<Rates, sizeof...(Runs)> out;
    for (int i = 0; i < turns; ++i) {
        std::size_t kind = 0;
        (add_rates(out[kind++], clock, blocks, std::ref(runs)), ...);
    }
    return out;
}

}  // namespace forage::bench
