#include "tools/forage/length.h"

#include <cmath>

#include <fmt/format.h>

namespace forage::tool {
namespace {

constexpr double default_seconds = 60;
constexpr double most_cycles = 1e15;

std::uint64_t cycles_in(double seconds, double seconds_per_cycle) {
    return static_cast<std::uint64_t>(std::min(std::ceil(seconds / seconds_per_cycle - 1e-9), most_cycles));
}

}  // namespace

void check_length(const RunOptions& o, const bug::World* world, Diagnostics& diagnostics) {
    if (!o.trials) return;
    const bool in_file = o.length_at.file != nullptr;
    const std::string trials = in_file ? "trials" : "--trials";
    const std::string otherwise =
        in_file ? "give the length in cycles or seconds" : "give the length with --cycles or --seconds";
    const auto refuse = [&](const std::string& why, const std::string& hint) {
        diagnostics.error(o.length_at, why, hint);
    };
    if (!world) {
        refuse(
            trials + (in_file ? " need a world" : " needs a world"),
            fmt::format("add {}, or {}", in_file ? "<world file=\"..\"/>" : "--world FILE.world", otherwise));
    } else if (world->bugs() == 0) {
        refuse(trials + ": there is no robot in the world", otherwise);
    } else if (!world->reset_plan()) {
        refuse(trials + ": this world never resets the robot, so it has no trials",
               otherwise + ", or add models named Reset_0, Reset_1, ... to the world");
    } else if (world->seconds_per_cycle() > 1) {
        refuse(fmt::format("{}: a cycle takes {:g} s of the world, longer than a reset", trials,
                           world->seconds_per_cycle()),
               in_file ? "choose a smaller pace of the world" : "choose a smaller --world-pace");
    }
}

Length::Length(const RunOptions& o, const bug::World* world, double seconds_per_cycle)
    : world_(world), longest_seconds_(o.longest_trial) {
    if (o.cycles)
        cycles_ = *o.cycles;
    else if (!o.trials)
        cycles_ = cycles_in(o.seconds.value_or(default_seconds), seconds_per_cycle);
    if (o.trials) {
        trials_ = *o.trials;
        longest_trial_ = cycles_in(o.longest_trial, seconds_per_cycle);
    }
}

bool Length::over(std::uint64_t cycle) const {
    return cycles_ ? cycle >= *cycles_ : world_->trials(0).size() >= trials_;
}

std::string Length::hopeless() const {
    if (cycles_ || world_->current_trial(0).cycles < longest_trial_) return {};
    return fmt::format("trial {} did not end within {:g} s (--longest-trial)", world_->trials(0).size() + 1,
                       longest_seconds_);
}

double Length::done(std::uint64_t cycle) const {
    if (cycles_) return static_cast<double>(cycle) / static_cast<double>(*cycles_);
    return static_cast<double>(world_->trials(0).size()) / static_cast<double>(trials_);
}

std::string Length::text() const {
    if (!world_ || world_->bugs() == 0 || !world_->reset_plan()) return {};
    std::size_t reached = 0;
    for (const auto& t : world_->trials(0)) reached += t.reached_target;
    return fmt::format("{}{} trials, {} at the target", world_->trials(0).size(),
                       cycles_ ? "" : fmt::format("/{}", trials_), reached);
}

}  // namespace forage::tool
