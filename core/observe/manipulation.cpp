#include "core/observe/manipulation.h"

namespace forage::observe {

Manipulation::Manipulation(Settings settings) : s_(std::move(settings)), waited_(s_.every - 1) {}

void Manipulation::look(const engine::Simulation& simulation, const SimTime& now) {
    if (!begun_) begun_ = !s_.from || s_.from->holds(simulation, now);
    if (begun_ && s_.until && !over_) over_ = s_.until->holds(simulation, now);
}

void Manipulation::apply(engine::Simulation& simulation) {
    if (!begun_ || over_ || ++waited_ < s_.every) return;
    waited_ = 0;
    const auto& pattern = s_.patterns[s_.backwards ? s_.patterns.size() - 1 - next_ : next_];
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
