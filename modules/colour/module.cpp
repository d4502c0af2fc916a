#include "modules/colour/module.h"

#include <cstring>

#include <fmt/format.h>

namespace forage::colour {
namespace {

/// Compares the bits, which is fast.
bool same(const double* a, const Eigen::ArrayXd& b) {
    return std::memcmp(a, b.data(), static_cast<std::size_t>(b.size()) * sizeof *a) == 0;
}

}  // namespace

void ColourModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    const auto &hue = ports.inputs[0], &value = ports.inputs[1], &colour = ports.outputs[0];
    const auto rectangular = [](const GroupShape& s) { return s.cells == s.width * s.height; };
    for (const auto* group : {&hue, &colour})
        if (!rectangular(group->shape)) {
            diagnostics.error(
                at_port(group->port),
                fmt::format("'{}' needs a rectangular group; '{}' is sparse", group->port, group->path),
                "give the group a TopologyRect");
            return;
        }
    if (colour.shape.width != hue.shape.width || colour.shape.height % hue.shape.height != 0)
        diagnostics.error(
            at_port("_color"),
            fmt::format("'_color' needs the width of '_hue' and a multiple of its height: '{}' has {} x {} "
                        "cells, '{}' has {} x {}",
                        colour.path, colour.shape.width, colour.shape.height, hue.path, hue.shape.width,
                        hue.shape.height),
            fmt::format("make it {} x {} for 12 colours", hue.shape.width, 12 * hue.shape.height));
    if (value.shape.cells < hue.shape.cells)
        diagnostics.error(
            at_port("_value"),
            fmt::format("'_value' needs a value for each of the {} cells of '_hue'; '{}' has {}",
                        hue.shape.cells, value.path, value.shape.cells),
            fmt::format("make the group {} x {}", hue.shape.width, hue.shape.height));
}

void ColourModule::start(const ModulePorts& ports) {
    const auto &hue = ports.inputs[0].shape, &colour = ports.outputs[0].shape;
    bins_ = HueBins(colour.cells / hue.cells);
    hue_.setZero(hue.cells);
    value_.setZero(hue.cells);
    computed_ = false;
}

void ColourModule::update(ModuleFrame& frame) {
    if (!frame.is_read(0)) return;
    const auto& hue = frame.input(0);
    const auto value = frame.input(1).head(hue.size());
    if (computed_ && same(hue.data(), hue_) && same(value.data(), value_))
        return;  // a camera may have fewer pictures than cycles
    bins_.separate(hue, value, frame.output(0));
    hue_ = hue;
    value_ = value;
    computed_ = true;
}

}  // namespace forage::colour
