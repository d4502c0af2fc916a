#include "tools/forage/measures.h"

#include <algorithm>
#include <cmath>

namespace forage::tool {
namespace {

/// The nearest start position, from 1; 0 when the world has none.
int start_position(const bug::World& world, const Pose2& start) {
    const auto plan = world.reset_plan();
    if (!plan) return 0;
    const auto distance = [&](const Pose2& p) { return std::hypot(p.x - start.x, p.y - start.y); };
    const auto nearest =
        std::min_element(plan->starts.begin(), plan->starts.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    return static_cast<int>(nearest - plan->starts.begin()) + 1;
}

}  // namespace

std::optional<TrialMeasures::Peaks> TrialMeasures::peaks() const {
    if (!discrepancy || patches.size() < 2) return {};
    Peaks out{patches.back().prototype_peak, 0};
    for (std::size_t i = 0; i + 1 < patches.size(); ++i)
        out.distractor = std::max(out.distractor, patches[i].prototype_peak);
    return out;
}

Measures::Measures(const bug::World& world, std::size_t robot, const engine::Layout& layout)
    : world_(world), robot_(robot), patches_(bug::patches_of(world.scene()->floors())) {
    if (world.bugs() == 1) layers_ = Layers(layout);
}

void Measures::follow(const engine::Simulation& simulation) {
    const auto& trials = world_.trials(robot_);
    while (finished_.size() < trials.size()) {
        finished_.push_back(at_end(trials[finished_.size()], simulation));
        seen_.clear();
    }
    if (world_.resetting(robot_)) return;
    const int patch = bug::patch_at(patches_, world_.looks_at(robot_));
    if (patch >= 0 && (seen_.empty() || seen_.back().patch != patch)) seen_.push_back({patch, 0});
    if (!seen_.empty() && layers_ && layers_->adaptive())
        seen_.back().prototype_peak =
            std::max(seen_.back().prototype_peak, layers_->prototype_peak(simulation));
}

TrialMeasures Measures::at_end(const Trial& trial, const engine::Simulation& simulation) const {
    TrialMeasures out{start_position(world_, trial.start), seen_, {}, {}};
    if (layers_ && layers_->adaptive()) out.discrepancy = layers_->discrepancy(simulation);
    if (layers_ && layers_->contextual()) out.memory = layers_->memory(simulation);
    return out;
}

std::vector<TrialMeasures> Measures::trials(const engine::Simulation& simulation) const {
    auto out = finished_;
    out.push_back(at_end(world_.current_trial(robot_), simulation));
    return out;
}

std::string Measures::route(const TrialMeasures& trial) const {
    std::string out;
    for (const Sighting& s : trial.patches)
        out += (out.empty() ? "" : " > ") + patches_[static_cast<std::size_t>(s.patch)].colour;
    return out;
}

}  // namespace forage::tool
