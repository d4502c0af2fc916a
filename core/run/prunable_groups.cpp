#include "core/run/prunable_groups.h"

#include <algorithm>

#include "core/engine/plan/compile.h"

namespace forage {

std::size_t prunable_groups(Run& run, std::span<const int> read) {
    if (!run.demand().reads_everything()) return 0;
    engine::Demand demand;
    for (const auto& o : run.observers()) o->declare(demand);
    for (const int group : read) demand.read_group(group);
    const auto pruned = engine::prune(run.layout(), demand).groups;
    return static_cast<std::size_t>(std::ranges::count(pruned, true));
}

}  // namespace forage
