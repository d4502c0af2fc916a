#include "core/run/layers.h"

#include <string_view>
#include <utility>

namespace forage {
namespace {

int find_module(const engine::Layout& layout, std::string_view type) {
    for (int i = 0; i < std::ssize(layout.modules); ++i)
        if (layout.modules[i].type.name == type) return i;
    return -1;
}

int find_output(const engine::Layout& layout, int module, std::string_view port) {
    if (module < 0) return -1;
    const auto& outputs = layout.modules[module].ports.outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i)
        if (outputs[i].port == port && outputs[i].shape.cells > 0) return static_cast<int>(i);
    return -1;
}

}  // namespace

Layers::Layers(const engine::Layout& layout)
    : adaptive_(find_module(layout, "moduleAL")),
      contextual_(find_module(layout, "moduleCL")),
      discrepancy_(find_output(layout, adaptive_, "descripancy")),
      prototype_(find_output(layout, adaptive_, "prototype")),
      empty_(find_output(layout, contextual_, "empty")) {}

double Layers::discrepancy(const engine::Simulation& simulation) const {
    return simulation.module_output(adaptive_, discrepancy_)[0];
}

double Layers::prototype_peak(const engine::Simulation& simulation) const {
    return simulation.module_output(adaptive_, prototype_).maxCoeff();
}

MemoryFill Layers::memory(const engine::Simulation& simulation) const {
    if (empty_ < 0) return {};
    const auto& shape = simulation.layout().modules[contextual_].ports.outputs[empty_].shape;
    MemoryFill out{0, 0, static_cast<std::size_t>(shape.height), static_cast<std::size_t>(shape.cells)};
    if (!simulation.has_written(contextual_, empty_)) return out;  // the layer is not open yet
    const ConstColumn empty = simulation.module_output(contextual_, empty_);
    for (int row = 0; row < shape.height; ++row) {
        const auto line = empty.segment(row * shape.width, shape.width);
        out.sequences += line[0] == 0;
        out.segments += static_cast<std::size_t>((line == 0).count());
    }
    return out;
}

void Layers::declare(engine::Demand& out) const {
    for (const auto& [module, port] : {std::pair(adaptive_, discrepancy_), std::pair(adaptive_, prototype_),
                                       std::pair(contextual_, empty_)})
        if (port >= 0) out.read_output(module, port);
}

}  // namespace forage
