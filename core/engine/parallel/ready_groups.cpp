#include "core/engine/parallel/ready_groups.h"

#include <algorithm>

#include "core/engine/early_delivery.h"
#include "core/engine/plan/plan.h"

namespace forage::engine {
namespace {

auto& at(auto& all, int index) { return all[static_cast<std::size_t>(index)]; }

}  // namespace

ReadyGroups::ReadyGroups(const Plan& plan, std::span<const std::vector<int>> shares, double worth)
    : worth_(worth), groups_(plan.groups.size()), left_(plan.groups.size()) {
    std::vector<std::vector<int>> readers(plan.groups.size());
    for (const int i : plan.updated) {
        const auto awaited = awaited_updates(plan, i);
        const auto divided = [&](int g) { return at(plan.groups, g).update_divides; };
        const auto& g = at(plan.groups, i);
        if (!g.module_inputs.empty() || g.delivery_divides || std::ranges::any_of(awaited, divided)) {
            some_late_ = true;
            continue;
        }
        at(groups_, i).awaited = static_cast<int>(awaited.size());
        at(groups_, i).cost = g.delivery_cost;
        for (const int source : awaited) at(readers, source).push_back(i);
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        groups_[i].first_reader = static_cast<int>(readers_.size());
        readers_.insert(readers_.end(), readers[i].begin(), readers[i].end());
        groups_[i].last_reader = static_cast<int>(readers_.size());
    }
    constexpr int line = 64 / sizeof(std::atomic<int>);
    int counts = 0;
    for (const auto& share : shares) {
        for (const int i : share) at(groups_, i).count = counts++;
        counts += line;
    }
    missing_ = std::vector<std::atomic<int>>(static_cast<std::size_t>(counts));
    restart();
}

void ReadyGroups::begin() {
    if (!some_left_.load(std::memory_order_relaxed)) return;
    some_left_.store(false, std::memory_order_relaxed);
    std::ranges::fill(left_, 0);
}

void ReadyGroups::restart() {
    for (const auto& g : groups_)
        if (g.awaited > 0) at(missing_, g.count).store(g.awaited, std::memory_order_relaxed);
}

}  // namespace forage::engine
