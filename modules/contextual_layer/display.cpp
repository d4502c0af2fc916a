#include "modules/contextual_layer/display.h"

namespace forage::contextual {

void show(const ContextualLayer& layer, const SegmentArray& numbers, bool whole, Cells cells) {
    const auto& memory = layer.memory();
    for (Index row = 0; row < memory.sequences(); ++row) {
        const Index n = whole || row == layer.stored_row() ? memory.segments() : memory.length(row);
        cells.segment(row * memory.segments(), n) = numbers.row(row).head(n).cast<double>().transpose();
    }
}

void show_empty(const ContextualLayer& layer, bool whole, Cells cells) {
    const auto& memory = layer.memory();
    for (Index row = 0; row < memory.sequences(); ++row) {
        if (!whole && row != layer.stored_row()) continue;
        auto line = cells.segment(row * memory.segments(), memory.segments());
        line.setOnes();
        line.head(memory.length(row)).setZero();
    }
}

}  // namespace forage::contextual
