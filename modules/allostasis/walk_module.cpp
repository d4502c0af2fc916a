#include "modules/allostasis/walk_module.h"

#include <fmt/format.h>

#include "core/types/cell_model.h"
#include "modules/allostasis/bug.h"

namespace forage::allostasis {

void WalkModule::describe(ModuleSpec<WalkModule>& s) {
    using T = WalkModule;
    s.name("moduleRandomWalk", "Random Walk")
        .doc(
            "Walks at random and turns away from obstacles, as the mate and the predator do in the arena of "
            "moduleAllostasis.");
    s.param("Scale", &T::scale)
        .range(0.1, 100)
        .doc("Metres of the world per metre of the original arena, which measures 3.5 m x 3.5 m.");
    s.param("Lowest", &T::lowest)
        .unit("rad/s")
        .range(0, 6.2)
        .doc("Lowest speed of a wheel; 1 for the predator.");
    s.param("Highest", &T::highest)
        .unit("rad/s")
        .range(0, 6.2)
        .doc("Highest speed of a wheel; 4 for the predator.");
    s.param("Fastest Turn", &T::fastest_turn)
        .unit("rad/s")
        .range(0, 6.2)
        .doc("Highest speed of the outer wheel while it turns away from an obstacle; 2.5 for the predator.");
    s.param("Interval", &T::interval)
        .unit("cycles")
        .range(1, 1000)
        .doc("Cycles between random changes of speed: 8 at 40 ms per cycle, about 0.32 s.");
    s.input("proximity", "Proximity").cells(32).doc("The proximity sensors of the Bug.");
    describe_motor(s);
}

void WalkModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    if (!(scale > 0))
        diagnostics.error(at_parameter("Scale"), fmt::format("'Scale' is {}", scale), "use more than 0");
    if (lowest > highest)
        diagnostics.error(at_parameter("Lowest"),
                          fmt::format("'Lowest' is {}, 'Highest' only {}", lowest, highest));
}

void WalkModule::start(const ModulePorts& ports) {
    walk_ = {};
    random_ = ports.random;
    width_ = ports.outputs[0].shape.width;
    height_ = ports.outputs[0].shape.height;
}

void WalkModule::update(ModuleFrame& frame) {
    Eigen::Array<double, 8, 1> ranges;
    for (std::size_t i = 0; i < ray_of.size(); ++i)
        ranges[static_cast<Index>(i)] = range(frame.input(0)[ray_of[i]], scale);
    const auto number = [&](std::uint32_t i) { return random_.uniform(frame.cycle(), i); };
    const Wheels z{normal(number(0), number(1)), normal(number(2), number(3))};
    auto motor = frame.output(0);
    show_wheels(walk_.step(ranges, z, {lowest, highest, fastest_turn, interval}), width_, height_, motor);
}

}  // namespace forage::allostasis
