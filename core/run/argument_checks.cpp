#include "core/run/argument_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/run/input_error.h"

namespace forage {
namespace {

constexpr std::uint64_t max_count = 1'000'000'000'000'000;
constexpr double max_seconds = 1e9;
constexpr double max_distance = 1e4;  ///< m
constexpr int max_threads = 1024;

}  // namespace

void check_finite(std::span<const double> numbers, const std::string& what) {
    const auto wrong = std::ranges::find_if(numbers, [](double x) { return !std::isfinite(x); });
    if (wrong != numbers.end()) throw InputError(fmt::format("{}: {} is not a finite number", what, *wrong));
}

void check_pose(double x, double y, std::optional<double> heading) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(heading.value_or(0)))
        throw InputError("a place has finite numbers", "x and y in m, the heading in rad");
    if (std::abs(x) > max_distance || std::abs(y) > max_distance) throw InputError("a place is within 10 km");
}

bool check_threads(int threads, Diagnostics& diagnostics) {
    const bool fine = threads >= 1 && threads <= max_threads;
    if (!fine)
        diagnostics.error({}, fmt::format("threads: {} is not a number of threads", threads),
                          fmt::format("a whole number from 1 to {}", max_threads));
    return fine;
}

bool check_length(const RunLength& length, Diagnostics& diagnostics) {
    const int errors = diagnostics.errors();
    const bool option = !length.in_code && !length.at.file;
    const auto count = [&](const char* name, const std::optional<std::uint64_t>& n) {
        if (n > max_count)
            diagnostics.error(length.at, fmt::format("{}{}: {} is too many", option ? "--" : "", name, *n),
                              "at most 1e15");
    };
    const auto time = [&](const char* name, double s, bool positive) {
        if (!(s >= 0 && s <= max_seconds) || (positive && s == 0))
            diagnostics.error(
                length.at, fmt::format("{}: {} is not a length of time", name, s),
                fmt::format("a number of seconds {}, at most 1e9", positive ? "above 0" : "from 0 on"));
    };
    if (length.cycles.has_value() + length.seconds.has_value() + length.trials.has_value() > 1)
        diagnostics.error(length.at, "cycles, seconds, trials: a run has only one length",
                          "give one of them");
    count("cycles", length.cycles);
    count("trials", length.trials);
    time(option ? "--seconds" : "seconds", length.seconds.value_or(0), false);
    time(option ? "--trial-timeout" : "trial_timeout", length.trial_timeout, true);
    return diagnostics.errors() == errors;
}

}  // namespace forage
