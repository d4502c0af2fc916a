#include "core/engine/early_delivery.h"

#include <algorithm>

#include "core/engine/plan.h"

namespace forage::engine {

EarlyDelivery::EarlyDelivery(const Plan& plan) {
    std::vector<std::size_t> update(plan.groups.size());  // which one is the group's
    for (std::size_t k = 0; k < plan.updated.size(); ++k)
        update[static_cast<std::size_t>(plan.updated[k])] = k;
    std::vector<std::vector<int>> after(plan.updated.size());
    for (const int i : plan.updated) {
        const auto& g = plan.groups[static_cast<std::size_t>(i)];
        if (!g.module_inputs.empty()) {
            late_.push_back(i);
            continue;
        }
        std::size_t last = update[static_cast<std::size_t>(i)];
        for (const int c : g.incoming) {
            const int source = plan.connections[static_cast<std::size_t>(c)].source;
            last = std::max(last, update[static_cast<std::size_t>(source)]);
        }
        after[last].push_back(i);
    }
    for (const auto& groups : after) {
        begin_.push_back(groups_.size());
        groups_.insert(groups_.end(), groups.begin(), groups.end());
    }
    begin_.push_back(groups_.size());
}

}  // namespace forage::engine
