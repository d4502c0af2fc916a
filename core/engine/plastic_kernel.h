// Connections whose synapses have a state of their own or read their target: types with an update().
#pragma once

#include "core/engine/arena.h"
#include "core/engine/kernel.h"

namespace forage::engine {

class PlasticKernel final : public Kernel {
  public:
    /// Reserves the synapses' states in `arena`. `synapse` stays the owner's.
    PlasticKernel(connectivity::Synapses synapses, int target_cells, const SynapseType& type,
                  const SynapseInstance& synapse, Arena& arena);
    /// Once, after the arena is allocated. `feedback`: the target's states that the type reads, in order of
    /// declaration; null rows for one that the file leaves unset, which reads 0.
    void place(Arena& arena, std::vector<Ring> feedback);

    /// Updates the synapses, in every cycle; deliver() does this first. On its own it is for connections of a
    /// kind that the target does not read: they learn all the same.
    void learn(const History& source);
    void deliver(const History& source, double* target) override;
    std::string_view form() const override { return "plastic"; }
    double cost() const override { return 5 * static_cast<double>(size_); }

    /// State `i` of the type, per synapse in synapse order. The output state is what was computed in this
    /// cycle, attenuated.
    ConstColumn state(std::size_t i) const { return {states_[i].data(), states_[i].size()}; }

  private:
    /// Learns block by block: what is gathered for an update then stays in the nearest cache.
    static constexpr Index block = 1024;
    void learn_block(const History& source, Index first, Index size);
    void sum_now(double* sums) const;

    const SynapseInstance& synapse_;
    std::size_t output_;  ///< index of the output state
    std::vector<int> pre_cell_, post_cell_, delay_;
    std::vector<double> factor_;  ///< reference - attenuation
    int longest_;                 ///< delay
    Index size_, target_cells_;
    Arena::Offset pre_offset_, psp_offset_ = 0, sum_offset_;
    std::vector<Arena::Offset> state_offsets_, feedback_offsets_;
    std::vector<double> initial_;  ///< of the states

    double* pre_ = nullptr;       ///< source activity, per synapse of a block
    double* psp_ring_ = nullptr;  ///< attenuated output of the last longest_ + 1 cycles; null without delays
    double* sums_ = nullptr;      ///< per target cell
    std::vector<double*> gathered_;  ///< feedback, per synapse of a block
    std::vector<Ring> feedback_;
    std::vector<Column> states_, block_states_;  ///< of all synapses, and of a block
    std::vector<ConstColumn> feedback_columns_;
    std::vector<const double*> feedback_rows_, psp_rows_;  ///< by delay; filled anew in each cycle
};

}  // namespace forage::engine
