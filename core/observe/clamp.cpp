#include "core/observe/clamp.h"

#include <algorithm>

namespace forage::observe {

void Clamp::add(std::int64_t cycle, int group, std::vector<double> values) {
    waiting_.emplace(cycle, Entry{group, std::move(values)});
}

void Clamp::after_groups(RunView& run) {
    const auto now = static_cast<std::int64_t>(run.time.cycle);
    while (!waiting_.empty() && waiting_.begin()->first <= now) {
        Entry& entry = waiting_.begin()->second;
        const auto held =
            std::find_if(held_.begin(), held_.end(), [&](const Entry& e) { return e.group == entry.group; });
        if (held != held_.end())
            *held = std::move(entry);
        else
            held_.push_back(std::move(entry));
        waiting_.erase(waiting_.begin());
    }
    for (const Entry& e : held_)
        run.simulation.output(e.group) = ConstColumn(e.values.data(), static_cast<Index>(e.values.size()));
}

void Clamp::declare(engine::Demand& out) const {
    for (const auto& [cycle, entry] : waiting_) out.overwrite_group(entry.group);
    for (const Entry& e : held_) out.overwrite_group(e.group);
}

}  // namespace forage::observe
