#include "core/observe/group_statistics.h"

#include <algorithm>

namespace forage::observe {

void Spread::add(const ConstColumn& numbers) {
    for (const double n : numbers) {
        sum += n;
        least = std::min(least, n);
        most = std::max(most, n);
        active += n != 0;
    }
    count += static_cast<std::uint64_t>(numbers.size());
}

GroupStatistics::GroupStatistics(const engine::Layout& layout) : groups_(layout.groups.size()) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
        groups_[g].states.resize(layout.groups[g].type.states.size());
}

void GroupStatistics::after_cycle(RunView& run) {
    for (int g = 0; g < std::ssize(groups_); ++g) {
        auto& group = groups_[static_cast<std::size_t>(g)];
        for (std::size_t s = 0; s < group.states.size(); ++s)
            group.states[s].add(run.simulation.state(g, static_cast<int>(s)));
        for (std::size_t k = 0;
             k < run.simulation.layout().groups[static_cast<std::size_t>(g)].type.input_count(); ++k)
            group.inputs[k].add(run.simulation.input(g, static_cast<InputKind>(k)));
    }
}

void GroupStatistics::checkpoint(Archive& archive) {
    const auto keep = [&](Spread& s) { archive(s.sum, s.least, s.most, s.count, s.active); };
    for (auto& g : groups_) {
        for (auto& s : g.states) keep(s);
        for (auto& i : g.inputs) keep(i);
    }
}

}  // namespace forage::observe
