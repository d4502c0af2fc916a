// Connections whose synapses have a state of their own or read their target: types with an update().
#pragma once

#include <memory>
#include <vector>

#include "core/engine/arena.h"
#include "core/engine/kernels/kernel.h"

namespace forage::engine {

class PlasticKernel : public Kernel {
  public:
    /// Once, after the arena is allocated. `feedback`: the target's states that the type reads, in order of
    /// declaration; null rows for one that the file leaves unset, which reads 0.
    virtual void place(Arena& arena, std::vector<Ring> feedback) = 0;

    /// Updates the synapses, in every cycle; deliver() does this first. On its own it is for connections of a
    /// kind that the target does not read: they learn all the same.
    virtual void learn(const History& source) = 0;

    /// State `i` of the type, per synapse in synapse order, until the next call. The output state is what was
    /// computed in this cycle, attenuated.
    virtual ConstColumn state(std::size_t i) const = 0;
};

/// Reserves the synapses' states in `arena`. `synapse` stays the owner's.
std::unique_ptr<PlasticKernel> make_plastic(connectivity::Synapses synapses, int source_cells,
                                            int target_cells, const SynapseType& type,
                                            const SynapseInstance& synapse, Arena& arena, Forms forms);

}  // namespace forage::engine
