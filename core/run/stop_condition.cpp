#include "core/run/stop_condition.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/run/argument_checks.h"
#include "core/run/run.h"

namespace forage {
namespace {

constexpr double default_seconds = 60;
constexpr double max_cycles = 1e15;
constexpr double rounding = 1e-9;  ///< of a number of cycles

/// The smallest number of whole cycles that are at least `cycles`.
std::uint64_t whole(double cycles) {
    return static_cast<std::uint64_t>(std::clamp(std::ceil(cycles - rounding), 0.0, max_cycles));
}

void check_trials(const RunLength& length, const Run& run, Diagnostics& diagnostics) {
    const bool in_file = length.at.file != nullptr, plain = in_file || length.in_code;
    const std::string trials = plain ? "trials" : "--trials";
    const std::string otherwise =
        plain ? "give the length in cycles or seconds" : "give the length with --cycles or --seconds";
    const auto refuse = [&](const std::string& why, const std::string& hint) {
        diagnostics.error(length.at, why, hint);
    };
    const Environment* environment = run.environment();
    if (!environment) {
        const char* add = in_file          ? "add <world file=\"..\"/>"
                          : length.in_code ? "open the run with a world"
                                           : "add --world FILE.world";
        refuse(trials + (plain ? " need a world" : " needs a world"),
               fmt::format("{}, or {}", add, otherwise));
    } else if (environment->robot_names().empty()) {
        refuse(trials + ": there is no robot in the world", otherwise);
    } else if (environment->start_poses().empty()) {
        refuse(trials + ": this world never resets the robot, so it has no trials",
               otherwise + ", or add models named Reset_0, Reset_1, ... to the world");
    } else if (environment->seconds_per_cycle() > 1) {
        refuse(fmt::format("{}: a cycle takes {:g} s of the world, longer than a reset", trials,
                           environment->seconds_per_cycle()),
               in_file          ? "choose a smaller pace of the world"
               : length.in_code ? "choose a smaller real_time_factor"
                                : "choose a smaller --real-time-factor");
    }
}

}  // namespace

StopCondition StopCondition::make(const RunLength& length, const Run& run, Diagnostics& diagnostics) {
    StopCondition out;
    if (!check_length(length, diagnostics)) return out;
    out.length_ = length;
    if (length.trials) check_trials(length, run, diagnostics);
    if (length.cycles) {
        out.cycles_ = *length.cycles;
    } else if (length.seconds || (!length.trials && length.until.empty())) {
        const double wanted =
            length.seconds.value_or(default_seconds) / run.seconds_per_cycle() - run.overrun();
        out.cycles_ = whole(wanted);
        out.overrun_ = static_cast<double>(*out.cycles_) - wanted;
        if (out.overrun_ < rounding) out.overrun_ = 0;
    }
    out.timeout_ = whole(length.trial_timeout / run.seconds_per_cycle());
    if (!length.until.empty())
        out.until_ = observe::parse_condition(run.layout(), run.has_trials(), length.until.text,
                                              length.in_code || length.until.at.file ? "until" : "--until",
                                              diagnostics, length.until.at);
    return out;
}

StopCondition::Origin StopCondition::begin(const Run& run) {
    return {run.cycle(), run.has_trials() ? run.environment()->trials(0).size() : 0};
}

bool StopCondition::reached(const Run& run, const Origin& origin) const {
    if (cycles_ && run.cycle() >= origin.cycles + *cycles_) return true;
    if (length_.trials && run.environment()->trials(0).size() >= origin.trials + *length_.trials) return true;
    return holds(run);
}

bool StopCondition::holds(const Run& run) const {
    return until_ && until_->holds(run.simulation(), run.time());
}

std::string StopCondition::timeout_reason(const Run& run) const {
    if (!length_.trials || run.environment()->current_trial(0).cycles < timeout_) return {};
    return fmt::format("trial {} did not end within {:g} s ({})", run.environment()->trials(0).size() + 1,
                       length_.trial_timeout, length_.in_code ? "trial_timeout" : "--trial-timeout");
}

double StopCondition::fraction_done(const Run& run, const Origin& origin) const {
    if (length_.trials)
        return static_cast<double>(run.environment()->trials(0).size() - origin.trials) /
               static_cast<double>(*length_.trials);
    return cycles_ ? static_cast<double>(run.cycle() - origin.cycles) / static_cast<double>(*cycles_) : 0;
}

std::string StopCondition::progress(const Run& run) const {
    const Environment* environment = run.environment();
    if (!environment || environment->robot_names().empty() || environment->start_poses().empty()) return {};
    const auto& trials = environment->trials(0);
    const auto reached = std::ranges::count_if(trials, &Trial::reached_target);
    return fmt::format("{}{} trials, {} at the target", trials.size(),
                       length_.trials ? fmt::format("/{}", *length_.trials) : "", reached);
}

}  // namespace forage
