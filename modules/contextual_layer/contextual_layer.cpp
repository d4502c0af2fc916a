#include "modules/contextual_layer/contextual_layer.h"

#include <algorithm>

#include "modules/contextual_layer/selection.h"

namespace forage::contextual {

ContextualLayer::ContextualLayer(Index sequences, Index segments, Index prototype_cells, Index action_cells)
    : recent_(std::min(sequences, segments), prototype_cells, action_cells),
      memory_(sequences, segments, prototype_cells, action_cells),
      action_(Eigen::ArrayXf::Zero(action_cells)) {}

bool ContextualLayer::update(const Inputs& in, const Settings& settings) {
    const auto discrepancy = static_cast<float>(in.discrepancy);
    if (discrepancy > 1e-6 && discrepancy < static_cast<float>(settings.discrepancy_threshold)) open_ = true;
    if (!open_) return false;
    acquire(in);
    memory_.compare(in.prototype);
    const auto threshold = static_cast<float>(settings.memory_threshold),
               share = static_cast<float>(settings.winner_share);
    memory_.collect(static_cast<float>(settings.trigger_decay));
    select(memory_, threshold, share, static_cast<float>(settings.trigger_reset));
    sum_actions(memory_, action_);
    return true;
}

void ContextualLayer::acquire(const Inputs& in) {
    const bool goal = in.positive_goal > 0;
    stored_row_ = -1;
    if (!goal && in.negative_goal > 0) recent_.clear();
    if ((in.prototype > 0).any()) recent_.append(in.prototype, in.action);
    if (!goal || recent_.size() == 0) return;
    stored_row_ = memory_.next_row();
    memory_.store(recent_);
    recent_.clear();
}

}  // namespace forage::contextual
