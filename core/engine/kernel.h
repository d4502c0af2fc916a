// What a connection does in a cycle, in the cheapest form that gives the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/connectivity/connect.h"
#include "core/types/synapse.h"

namespace forage::engine {

/// The activity of a connection's source in this and in earlier cycles.
struct History {
    const double* now;          ///< row of this cycle
    const double* ring;         ///< rows of the last `depth` cycles, row t % depth is that of cycle t; null: only now
    std::int64_t depth, stride;
    std::uint64_t cycle;

    const double* ago(int delay) const {
        if (!ring) return now;
        const auto row = static_cast<std::int64_t>(cycle % static_cast<std::uint64_t>(depth));
        return ring + ((row - delay + depth) % depth) * stride;
    }
};

class Kernel {
  public:
    virtual ~Kernel() = default;
    /// Adds to each cell of `target` the sum, from 0 and in synapse order, of what its synapses deliver.
    virtual void deliver(const History& source, double* target) = 0;
    virtual std::string_view form() const = 0;
};

enum class Forms {
    fastest,  ///< the cheapest form that fits
    general,  ///< always the list of synapses: what the others are tested against
};

/// A kernel for synapses that multiply by a constant: psp = (gain * pre) * (reference - attenuation), rounded in this
/// order. `synapse` stays the owner's: its gain may change between cycles.
std::unique_ptr<Kernel> make_kernel(const connectivity::Synapses& synapses, int source_cells, int target_cells,
                                    const SynapseInstance& synapse, Forms forms);

}  // namespace forage::engine
