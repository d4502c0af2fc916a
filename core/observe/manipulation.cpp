#include "core/observe/manipulation.h"

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
        if (next_ > 0) apply(run.simulation, s_.patterns[next_ - 1]);
        return;
    }
    if (++waited_ < s_.every) return;
    waited_ = 0;
    apply(run.simulation, s_.patterns[s_.backwards ? s_.patterns.size() - 1 - next_ : next_]);
    next_ += s_.step;
    if (next_ < s_.patterns.size()) return;
    next_ = 0;
    over_ = s_.times && ++played_ == *s_.times;
}

void Manipulation::apply(engine::Simulation& simulation, const std::vector<double>& pattern) const {
    const ConstColumn values(pattern.data(), static_cast<Index>(pattern.size()));
    Column activity = simulation.output(s_.group);
    switch (s_.mode) {
        case Mode::clamp:
            activity = values;
            break;
        case Mode::add:
            activity += values;
            break;
        case Mode::multiply:
            activity *= values;
            break;
    }
}

void Manipulation::declare(engine::Demand& out) const {
    out.overwrite_group(s_.group);
    if (s_.from) s_.from->declare(out);
    if (s_.until) s_.until->declare(out);
}

}  // namespace forage::observe
