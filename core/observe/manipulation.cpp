#include "core/observe/manipulation.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace forage::observe {

Manipulation::Manipulation(Settings settings) : s_(std::move(settings)), waited_(s_.every - 1) {}

void Manipulation::before_cycle(RunView& run) {
    if (!begun_) begun_ = !s_.from || s_.from->holds(run.simulation, run.time);
    if (begun_ && s_.until && !over_) over_ = s_.until->holds(run.simulation, run.time);
}

void Manipulation::after_groups(RunView& run) {
    if (!begun_ || over_) return;
    if (!s_.starts.empty()) {
        const auto now = static_cast<std::int64_t>(run.time.cycle);
        while (next_ < s_.starts.size() && s_.starts[next_] <= now) ++next_;
        if (next_ > 0) apply(run, s_.patterns[next_ - 1]);
        return;
    }
    if (++waited_ < s_.every) return;
    waited_ = 0;
    apply(run, s_.patterns[s_.backwards ? s_.patterns.size() - 1 - next_ : next_]);
    next_ += s_.step;
    if (next_ < s_.patterns.size()) return;
    next_ = 0;
    over_ = s_.times && ++played_ == *s_.times;
}

void Manipulation::apply(RunView& run, const std::vector<double>& pattern) {
    if (s_.mode == Mode::clamp) return clamp(run, pattern);
    const ConstColumn values(pattern.data(), static_cast<Index>(pattern.size()));
    Column activity = run.simulation.output(s_.group);
    if (s_.mode == Mode::add)
        activity += values;
    else
        activity *= values;
}

void Manipulation::clamp(RunView& run, const std::vector<double>& pattern) {
    const auto cycle = static_cast<std::uint64_t>(run.time.cycle);
    const auto refuse = [&](const std::string& what) {
        throw std::runtime_error(
            fmt::format("two clamps set {} '{}' in cycle {}", what,
                        run.simulation.layout().groups[static_cast<std::size_t>(s_.group)].path, cycle));
    };
    Column activity = run.simulation.output(s_.group);
    bool first = true;
    for (const auto* m = earlier_; m; m = m->earlier_) {
        if (m->applied_ != cycle) continue;
        first = false;
        if (s_.cells.empty() || m->s_.cells.empty()) refuse("group");
        std::vector<int> both;
        std::ranges::set_intersection(s_.cells, m->s_.cells, std::back_inserter(both));
        if (!both.empty()) refuse(fmt::format("cell {} of group", both.front() + 1));
    }
    applied_ = cycle;
    if (s_.cells.empty()) {
        activity = ConstColumn(pattern.data(), static_cast<Index>(pattern.size()));
        return;
    }
    if (first) activity = 0.0;
    for (const int cell : s_.cells) activity[cell] = pattern[static_cast<std::size_t>(cell)];
}

void Manipulation::declare(engine::Demand& out) const {
    out.overwrite_group(s_.group);
    if (s_.from) s_.from->declare(out);
    if (s_.until) s_.until->declare(out);
}

}  // namespace forage::observe
