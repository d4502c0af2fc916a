#include "core/observe/manipulation.h"

namespace forage::observe {

Manipulation::Manipulation(Settings settings) : s_(std::move(settings)), waited_(s_.every - 1) {}

void Manipulation::before_cycle(RunView& run) {
    if (!begun_) begun_ = !s_.from || s_.from->holds(run.simulation, run.time);
    if (begun_ && s_.until && !over_) over_ = s_.until->holds(run.simulation, run.time);
}

void Manipulation::after_groups(RunView& run) {
    if (!begun_ || over_ || ++waited_ < s_.every) return;
    waited_ = 0;
    const auto& pattern = s_.patterns[s_.backwards ? s_.patterns.size() - 1 - next_ : next_];
    const ConstColumn values(pattern.data(), static_cast<Index>(pattern.size()));
    Column activity = run.simulation.output(s_.group);
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
    next_ += s_.step;
    if (next_ < s_.patterns.size()) return;
    next_ = 0;
    over_ = s_.times && ++played_ == *s_.times;
}

void Manipulation::declare(engine::Demand& out) const {
    out.overwrite_group(s_.group);
    if (s_.from) s_.from->declare(out);
    if (s_.until) s_.until->declare(out);
}

}  // namespace forage::observe
