#include "core/engine/early_delivery.h"

#include <algorithm>

#include "core/engine/plan/plan.h"

namespace forage::engine {

std::vector<int> awaited_updates(const Plan& plan, int group) {
    std::vector<int> out{group};
    for (const int c : plan.groups[static_cast<std::size_t>(group)].incoming) {
        const int source = plan.connections[static_cast<std::size_t>(c)].source;
        if (std::find(out.begin(), out.end(), source) == out.end()) out.push_back(source);
    }
    return out;
}

EarlyDelivery::EarlyDelivery(const Plan& plan) {
    std::vector<std::size_t> update(plan.groups.size());  // which one is the group's
    for (std::size_t k = 0; k < plan.updated.size(); ++k)
        update[static_cast<std::size_t>(plan.updated[k])] = k;
    std::vector<std::vector<int>> after(plan.updated.size());
    for (const int i : plan.updated) {
        if (!plan.groups[static_cast<std::size_t>(i)].module_inputs.empty()) {
            late_.push_back(i);
            continue;
        }
        std::size_t last = 0;
        for (const int awaited : awaited_updates(plan, i))
            last = std::max(last, update[static_cast<std::size_t>(awaited)]);
        after[last].push_back(i);
    }
    for (const auto& groups : after) {
        begin_.push_back(groups_.size());
        groups_.insert(groups_.end(), groups.begin(), groups.end());
    }
    begin_.push_back(groups_.size());
}

}  // namespace forage::engine
