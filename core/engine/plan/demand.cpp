#include "core/engine/plan/demand.h"

namespace forage::engine {

bool Demand::covers(const Demand& other) const {
    const auto in = [](const std::vector<int>& all) { return [&all](int n) { return contains(all, n); }; };
    const auto read = [&](const Output& o) {
        return std::any_of(outputs_.begin(), outputs_.end(), [&](const Output& mine) {
            return mine.module == o.module && mine.port == o.port;
        });
    };
    const bool reads =
        reads_everything_ ||
        (!other.reads_everything_ && std::ranges::all_of(other.groups_, in(groups_)) &&
         std::ranges::all_of(other.inputs_, in(inputs_)) &&
         std::ranges::all_of(other.synapses_, in(synapses_)) && std::ranges::all_of(other.outputs_, read));
    return reads && (overwrites_everything_ || (!other.overwrites_everything_ &&
                                                std::ranges::all_of(other.overwritten_, in(overwritten_))));
}

}  // namespace forage::engine
