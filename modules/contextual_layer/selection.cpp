#include "modules/contextual_layer/selection.h"

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

}  // namespace

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

}  // namespace forage::contextual
