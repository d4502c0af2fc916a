// What benchmarks say, for people and for programs.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
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

/// Seconds that this thread has computed: what else the machine does counts less than on a clock on the wall.
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

/// Runs per second: the median of 11 blocks of about a twentieth of a second, by either clock.
template <class Run>
double rate(double (*clock)(), Run run) {
    std::vector<double> rates;
    for (long runs = 1; rates.size() < 11;) {
        const double begin = clock();
        for (long i = 0; i < runs; ++i) run();
        const double seconds = clock() - begin;
        if (seconds < 0.05 && runs < 1'000'000)
            runs *= 2;
        else
            rates.push_back(static_cast<double>(runs) / seconds);
    }
    return median(rates);
}

}  // namespace forage::bench
