#include "modules/explore/explore.h"

#include <algorithm>

#include <fmt/format.h>

namespace forage::explore {

void ExploreModule::describe(ModuleSpec<ExploreModule>& s) {
    using T = ExploreModule;
    s.name("moduleExplore", "Explore")
        .doc("Walks at random: straight on for some decisions, then to one side for some.");
    s.param("Decision Interval", &T::interval)
        .unit("cycles")
        .range(1, 1000)
        .doc("An action lasts for so many cycles.");
    s.param("Longest Straight", &T::straight)
        .range(1, 1000)
        .doc("Most decisions in a row that go straight on; each number from 1 is equally likely.");
    s.param("Longest Turn", &T::turn).range(1, 1000).doc("The same for decisions in a row that turn.");
    s.input("trial", "Trial")
        .optional()
        .cells(2)
        .doc(
            "Cell 2 is above 0 between trials, as in '_trial' of moduleGazeboBug. An interval begins when a "
            "trial ends.");
    s.output("action", "Action")
        .cells(3)
        .names({"ahead", "left", "right"})
        .doc("1 at the action: ahead, left or right.");
}

void ExploreModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    for (const auto& [name, number] :
         {std::pair{"Decision Interval", interval}, std::pair{"Longest Straight", straight},
          std::pair{"Longest Turn", turn}})
        if (number < 1)
            diagnostics.error(at_parameter(name), fmt::format("'{}' is {}", name, number), "use at least 1");
}

void ExploreModule::start(const ModulePorts& ports) {
    random_ = ports.random;
    cycles_ = 0;
    decisions_ = straight_ = turn_ = side_ = 0;
}

void ExploreModule::draw(std::uint64_t cycle) {
    const auto whole = [&](int most, std::uint32_t index) {
        return 1 + static_cast<int>(random_.uniform(cycle, index) * std::max(most, 1));
    };
    decisions_ = 0;
    side_ = random_.uniform(cycle, 0) < 0.5 ? 0 : 1;
    straight_ = whole(straight, 1);
    turn_ = whole(turn, 2);
}

void ExploreModule::update(ModuleFrame& frame) {
    const auto& trial = frame.input(0);
    if (trial.size() == 2 && trial[1] > 0) cycles_ = 0;
    if (cycles_++ % std::max(interval, 1) != 0) return;
    if (decisions_++ >= straight_ + turn_) draw(frame.cycle()), decisions_ = 1;
    auto action = frame.output(0);
    action.setZero();
    action[decisions_ <= straight_ ? 0 : 1 + side_] = 1;
}

}  // namespace forage::explore
