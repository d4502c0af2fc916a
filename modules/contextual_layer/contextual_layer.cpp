#include "modules/contextual_layer/contextual_layer.h"

#include <algorithm>

#include "core/base/simd.h"

namespace forage::contextual {
namespace {

struct Rule {
    float threshold, min_collector, trigger_reset;
};

/// Selects among the n segments of a row. Returns whether a segment is selected.
FORAGE_SIMD bool select_row(const float* collector, Index n, Rule rule, float* selected, float* trigger) {
    int any = 0;
    for (Index i = 0; i < n; ++i) {
        const int chosen = (collector[i] > rule.threshold) & (collector[i] >= rule.min_collector);
        selected[i] = static_cast<float>(chosen);
        any |= chosen;
    }
    if (!any) return false;
    for (Index i = 0; i < n; ++i) trigger[i] = selected[i] > 0.0F ? 1.0F : trigger[i];
    for (Index i = 0; i + 1 < n; ++i) trigger[i] = selected[i + 1] > 0.0F ? rule.trigger_reset : trigger[i];
    return true;
}

/// Selects the used segments whose collector c is above `threshold` and at least `share` times the largest
/// collector (or 0 if no collector is above 0). The triggers of selected segments become 1. Then the trigger
/// of each segment that follows a selected one, which is one step nearer to the goal, becomes
/// `trigger_reset`, which favours it from the next update on.
void select(LongTermMemory& memory, float threshold, float share, float trigger_reset) {
    float largest = 0;
    for (Index row = 0; row < memory.sequences(); ++row) largest = std::max(largest, memory.peak(row));
    const Rule rule{threshold, share * largest, trigger_reset};
    for (Index row = 0; row < memory.sequences(); ++row) {
        const bool may_select = memory.peak(row) > rule.threshold && memory.peak(row) >= rule.min_collector;
        if (!may_select && !memory.has_selection(row)) continue;  // the usual case
        memory.has_selection(row) = select_row(&memory.collector()(row, 0), memory.length(row), rule,
                                               &memory.selected()(row, 0), &memory.trigger()(row, 0));
    }
}

/// out_m = sum of a_m c / (j + 1) over the selected segments in column j, added row by row in single
/// precision. `out` has M cells.
void sum_actions(const LongTermMemory& memory, Eigen::Ref<Eigen::ArrayXf> out) {
    out.setZero();
    for (Index row = 0; row < memory.sequences(); ++row) {
        if (!memory.has_selection(row)) continue;
        for (Index column = 0; column < memory.length(row); ++column)
            if (memory.selected()(row, column) > 0.0F)
                out += memory.action(row, column) * memory.collector()(row, column) /
                       static_cast<float>(column + 1);
    }
}

}  // namespace

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
