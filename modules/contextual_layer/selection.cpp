#include "modules/contextual_layer/selection.h"

#include <algorithm>

namespace forage::contextual {

void select(LongTermMemory& memory, float threshold, float share, float trigger_reset) {
    float largest = 0;
    for (Index row = 0; row < memory.sequences(); ++row)
        if (const Index n = memory.length(row); n > 0)
            largest = std::max(largest, memory.collector().row(row).head(n).maxCoeff());
    const float least = share * largest;
    for (Index row = 0; row < memory.sequences(); ++row) {
        const Index n = memory.length(row);
        if (n == 0) continue;
        const auto c = memory.collector().row(row).head(n);
        auto selected = memory.selected().row(row).head(n);
        auto trigger = memory.trigger().row(row).head(n);
        selected = (c > threshold && c >= least).cast<float>();
        trigger = (selected > 0.0F).select(1.0F, trigger);
        trigger.head(n - 1) = (selected.tail(n - 1) > 0.0F).select(trigger_reset, trigger.head(n - 1));
    }
}

void sum_actions(const LongTermMemory& memory, Eigen::Ref<Eigen::ArrayXf> out) {
    out.setZero();
    for (Index row = 0; row < memory.sequences(); ++row)
        for (Index column = 0; column < memory.length(row); ++column)
            if (memory.selected()(row, column) > 0.0F)
                out += memory.action(row, column) * memory.collector()(row, column) /
                       static_cast<float>(column + 1);
}

}  // namespace forage::contextual
