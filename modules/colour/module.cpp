#include "modules/colour/module.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

#include <fmt/format.h>

namespace forage::colour {
namespace {

/// Compares the bits, which is fast.
bool same(const double* a, const Eigen::ArrayXd& b) {
    return std::memcmp(a, b.data(), static_cast<std::size_t>(b.size()) * sizeof *a) == 0;
}

/// The hue in the middle of bin `b` of `n`.
std::string hue_name(int b, int n) {
    constexpr const char* wheel[] = {"red",  "orange",   "yellow", "yellow-green", "green",   "green-cyan",
                                     "cyan", "sky blue", "blue",   "violet",       "magenta", "pink"};
    constexpr int named = std::size(wheel);
    return named * b % n == 0 ? wheel[named * b / n] : fmt::format("hue {:.3g}°", 360.0 * b / n);
}

}  // namespace

void ColourModule::describe(ModuleSpec<ColourModule>& s) {
    s.name("moduleColor", "Color Module").doc("Separates a picture by hue: one picture per colour, stacked.");
    s.input("_hue", "Hue").full_rectangle().doc("The hue of each pixel, 0 to 1.");
    s.input("_value", "Value")
        .same_size_as("_hue")
        .tolerate([](PortSizes& of, const GroupShape& given) { return given.cells >= of["_hue"].cells; })
        .doc("The number of each pixel that is passed on, such as its saturation.");
    s.output("_color", "Color")
        .size("the width of '_hue' and a multiple of its height",
              [](const auto&, PortSizes& of, const GroupShape& given) {
                  const auto hue = of["_hue"];
                  return rectangle(hue.width,
                                   given.height % hue.height == 0 ? given.height : 12 * hue.height);
              })
        .doc(
            "One picture per bin of hues, from top to bottom; bin b of n, counted from 0, has its middle at "
            "b/n. A picture holds the values of the pixels whose hue is in its bin, and 0 elsewhere.")
        .names([](const auto&, const ModulePorts& ports, const GroupShape& shape) {
            const int height = std::max(1, ports.inputs[0].shape.height), bins = shape.height / height;
            CellNames out;
            for (int y = 0; y < bins * height; ++y) out.rows.push_back(hue_name(y / height, bins));
            return out;
        });
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
