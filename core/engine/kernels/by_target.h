// Synapses in the order in which targets sum them.
#pragma once

#include <vector>

namespace forage::engine {

/// Synapses sorted by target; those of one target stay in synapse order.
struct ByTarget {
    std::vector<int> start;  ///< of target t's synapses; one more entry than targets
    std::vector<int> pre, delay;
    std::vector<double> factor;

    std::size_t targets() const { return start.size() - 1; }
    int length(std::size_t target) const { return start[target + 1] - start[target]; }
};

}  // namespace forage::engine
