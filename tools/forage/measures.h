// What is measured of each trial, beyond where the robot went.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bug_interface/simulation/patches.h"
#include "bug_interface/simulation/world.h"
#include "tools/forage/layers.h"

namespace forage::tool {

/// A patch that came into view in a trial, and how strongly the adaptive layer responded until the next one.
struct Sighting {
    int patch = 0;              ///< of the world's patches
    double prototype_peak = 0;  ///< of the strongest cell of the prototype

    void checkpoint(Archive& archive) { archive(patch, prototype_peak); }
};

/// What is measured of a trial.
struct TrialMeasures {
    int start = 0;  ///< the start position, counted from 1 in the order of the world's Reset_0, Reset_1, ...
    std::vector<Sighting> patches;      ///< in the order in which the robot's camera was on them
    std::optional<double> discrepancy;  ///< of the adaptive layer, at the end
    std::optional<MemoryFill> memory;   ///< of the contextual layer, at the end

    /// The last patch of a trial is the cue: what to do there leads to the target. Those before are
    /// distractors. Peaks of the prototype, of the strongest distractor; empty with less than two patches or
    /// without an adaptive layer.
    struct Peaks {
        double cue, distractor;
    };
    std::optional<Peaks> peaks() const;

    void checkpoint(Archive& archive) { archive(start, patches, discrepancy, memory); }
};

/// Follows one robot and the layers of its system through a run.
class Measures {
  public:
    /// Reads the pictures of the world's floors. The first layers of a system are those of the only robot;
    /// with several robots nothing is measured of layers. Throws std::runtime_error when a picture cannot be
    /// read.
    Measures(const bug::World& world, std::size_t robot, const engine::Layout& layout);

    /// After each cycle of system and world.
    void follow(const engine::Simulation& simulation);

    /// One for each finished trial, and one more for the running one.
    std::vector<TrialMeasures> trials(const engine::Simulation& simulation) const;
    const std::vector<bug::Patch>& patches() const { return patches_; }
    /// "cyan > red": what came into view, by colour.
    std::string route(const TrialMeasures& trial) const;

    /// Demands what it reads.
    void declare(engine::Demand& out) const {
        if (layers_) layers_->declare(out);
    }

    void checkpoint(Archive& archive) { archive(finished_, seen_); }

  private:
    TrialMeasures at_end(const Trial& trial, const engine::Simulation& simulation) const;

    const bug::World& world_;
    std::size_t robot_;
    std::optional<Layers> layers_;
    std::vector<bug::Patch> patches_;
    std::vector<TrialMeasures> finished_;
    std::vector<Sighting> seen_;  ///< in the running trial
};

}  // namespace forage::tool
