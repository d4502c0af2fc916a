#include "core/run/trial_recorder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/run/environment.h"
#include "core/run/result_files.h"

namespace forage {

int start_number(const std::vector<Pose2>& starts, const Pose2& start) {
    if (starts.empty()) return 0;
    const auto distance = [&](const Pose2& p) { return std::hypot(p.x - start.x, p.y - start.y); };
    return static_cast<int>(std::ranges::min_element(starts, {}, distance) - starts.begin()) + 1;
}

std::optional<TrialMeasures::Peaks> TrialMeasures::peaks() const {
    if (!discrepancy || patches.size() < 2) return {};
    Peaks out{patches.back().prototype_peak, 0};
    for (std::size_t i = 0; i + 1 < patches.size(); ++i)
        out.distractor = std::max(out.distractor, patches[i].prototype_peak);
    return out;
}

std::size_t MeasuredTrials::reached() const {
    return static_cast<std::size_t>(std::ranges::count_if(finished, &MeasuredTrial::reached_target));
}

double MeasuredTrials::recent_success(std::size_t count) const {
    const std::size_t first = count - std::min(count, window);
    double reached = 0;
    for (std::size_t i = first; i < count; ++i) reached += finished[i].reached_target;
    return 100.0 * reached / static_cast<double>(count - first) /
           100;  // rounded as the percentage in the summary
}

TrialRecorder::TrialRecorder(const Environment& environment, std::size_t robot, const engine::Layout& layout,
                             std::string file)
    : robot_(robot),
      file_(std::move(file)),
      starts_(environment.start_poses()),
      colours_(environment.patch_colours()) {
    if (environment.robot_names().size() == 1) layers_ = Layers(layout);
}

void TrialRecorder::after_cycle(RunView& run) {
    const Environment& environment = *run.environment;
    const auto& trials = environment.trials(robot_);
    while (finished_.size() < trials.size()) {
        finished_.push_back(at_end(trials[finished_.size()], run.simulation));
        seen_.clear();
    }
    if (environment.resetting(robot_)) return;
    const auto patch = environment.patch_in_view(robot_);
    if (patch && (seen_.empty() || seen_.back().patch != *patch)) seen_.push_back({*patch, 0});
    if (!seen_.empty() && layers_ && layers_->adaptive())
        seen_.back().prototype_peak =
            std::max(seen_.back().prototype_peak, layers_->prototype_peak(run.simulation));
}

TrialMeasures TrialRecorder::at_end(const Trial& trial, const engine::Simulation& simulation) const {
    TrialMeasures out{start_number(starts_, trial.start), seen_, {}, {}};
    if (layers_ && layers_->adaptive()) out.discrepancy = layers_->discrepancy(simulation);
    if (layers_ && layers_->contextual()) out.memory = layers_->memory(simulation);
    return out;
}

MeasuredTrial TrialRecorder::measured(const Trial& trial, const TrialMeasures& measures) const {
    MeasuredTrial out{trial, measures, {}};
    for (const Sighting& s : measures.patches)
        out.route += (out.route.empty() ? "" : " > ") + colours_[s.patch];
    return out;
}

MeasuredTrials TrialRecorder::trials(const Environment& environment,
                                     const engine::Simulation& simulation) const {
    MeasuredTrials out;
    const auto& finished = environment.trials(robot_);
    for (std::size_t i = 0; i < finished.size(); ++i)  // one may have ended since the last cycle
        out.finished.push_back(
            measured(finished[i], i < finished_.size() ? finished_[i] : at_end(finished[i], simulation)));
    if (const Trial running = environment.current_trial(robot_); running.cycles > 0)
        out.running = measured(running, at_end(running, simulation));
    return out;
}

void TrialRecorder::finish(RunView& run, ResultFiles& files) {
    auto all = trials(*run.environment, run.simulation);
    if (!run.environment->has_trials(robot_)) all.running.reset();  // nothing ends this run of the robot
    files.write(file_, [&] { return trials_csv(all); });
}

const char* const trial_columns =
    "trial,start_x,start_y,start_yaw,cycles,smallest_distance,outcome,first_cycle,end_x,end_y,end_yaw,"
    "start,patches,recent_success,discrepancy,cue_peak,distractor_peak,sequences,segments\n";

std::string trials_csv(const MeasuredTrials& trials) {
    std::string out = trial_columns;
    const auto add = [&](const MeasuredTrial& t, const std::string& recent) {
        const auto& m = t.measures;
        const auto peaks = m.peaks();
        const bool finished = !recent.empty();
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", t.number, t.start.x, t.start.y,
            t.start.yaw, t.cycles,
            std::isfinite(t.smallest_distance) ? fmt::format("{}", t.smallest_distance) : "",
            t.reached_target ? "target"
            : finished       ? "missed"
                             : "unfinished",
            t.first_cycle, t.end.x, t.end.y, t.end.yaw, m.start ? fmt::format("{}", m.start) : "", t.route,
            recent, m.discrepancy ? fmt::format("{}", *m.discrepancy) : "",
            peaks ? fmt::format("{}", peaks->cue) : "", peaks ? fmt::format("{}", peaks->distractor) : "",
            m.memory ? fmt::format("{}", m.memory->sequences) : "",
            m.memory ? fmt::format("{}", m.memory->segments) : "");
    };
    for (std::size_t i = 0; i < trials.finished.size(); ++i)
        add(trials.finished[i], fmt::format("{}", trials.recent_success(i + 1)));
    if (trials.running) add(*trials.running, "");
    return out;
}

void Sighting::checkpoint(Archive& archive) { archive(patch, prototype_peak); }

void TrialMeasures::checkpoint(Archive& archive) { archive(start, patches, discrepancy, memory); }

void TrialRecorder::checkpoint(Archive& archive) { archive(finished_, seen_); }

}  // namespace forage
