// The measures of a robot's trials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/run/layers.h"
#include "core/run/trial.h"

namespace forage {

/// The number of the nearest start pose, from 1; 0 when there is none.
int start_number(const std::vector<Pose2>& starts, const Pose2& start);

/// A patch that came into view in a trial, and how strongly the adaptive layer responded until the next one.
struct Sighting {
    std::size_t patch = 0;      ///< index of Environment::patch_colours()
    double prototype_peak = 0;  ///< highest activity of a cell of the prototype

    void checkpoint(Archive& archive);
};

/// The measures of a trial apart from the robot's path.
struct TrialMeasures {
    /// The start pose, counted from 1 in the order of the world's Reset_0, Reset_1, ...; 0: unknown.
    int start = 0;
    std::vector<Sighting> patches;      ///< in the order in which they came into view
    std::optional<double> discrepancy;  ///< output of the adaptive layer at the end
    std::optional<MemoryFill> memory;   ///< the contextual layer's memory at the end

    /// The peaks of the prototype at the last patch (the cue, where the right action leads to the target),
    /// and at the strongest of the earlier patches (distractors).
    struct Peaks {
        double cue, distractor;
    };
    /// The peaks of the trial; empty with fewer than two patches or without an adaptive layer.
    std::optional<Peaks> peaks() const;

    void checkpoint(Archive& archive);
};

/// A trial and its measures.
struct MeasuredTrial : Trial {
    TrialMeasures measures;
    std::string route;  ///< the patches that came into view, by colour: "cyan > red"
};

/// The trials of a robot: the finished ones and the unfinished one, if it has begun.
struct MeasuredTrials {
    std::vector<MeasuredTrial> finished;
    std::optional<MeasuredTrial> running;

    static constexpr std::size_t window = 50;  ///< number of trials over which the success ratio is computed

    std::size_t reached() const;
    /// The share of trials that reached the target, 0..1, among the last `window` of the first `count`
    /// finished trials, or among all of these when they are fewer. `count` is above 0.
    double recent_success(std::size_t count) const;
};

/// The columns of trials.csv, in a line.
extern const char* const trial_columns;
/// The table trials.csv, one row per trial, in m and rad. Values that do not apply are empty.
/// docs/reference/results.md explains the columns.
std::string trials_csv(const MeasuredTrials& trials);

/// Follows one robot and the learning layers of its system through a run, and writes trials.csv.
class TrialRecorder final : public Observer {
  public:
    /// Layers are measured only when there is one robot. `file` is the name of the table. Throws
    /// std::runtime_error when a picture of the world's floors cannot be read.
    TrialRecorder(const Environment& environment, std::size_t robot, const engine::Layout& layout,
                  std::string file);

    std::size_t robot() const { return robot_; }
    MeasuredTrials trials(const Environment& environment, const engine::Simulation& simulation) const;

    void declare(engine::Demand& demand) const override {
        if (layers_) layers_->declare(demand);
    }
    void after_cycle(RunView& run) override;
    std::vector<std::string> file_names() const override { return {file_}; }
    void finish(RunView& run, ResultFiles& files) override;
    void checkpoint(Archive& archive) override;

  private:
    TrialMeasures at_end(const Trial& trial, const engine::Simulation& simulation) const;
    MeasuredTrial measured(const Trial& trial, const TrialMeasures& measures) const;

    std::size_t robot_;
    std::string file_;
    std::vector<Pose2> starts_;
    std::vector<std::string> colours_;  ///< colours of the patches
    std::optional<Layers> layers_;
    std::vector<TrialMeasures> finished_;
    std::vector<Sighting> seen_;  ///< the patches seen in the running trial
};

}  // namespace forage
