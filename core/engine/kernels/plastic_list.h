// Plastic synapses in synapse order: the general form.
#pragma once

#include "core/engine/kernels/plastic_kernel.h"

namespace forage::engine {

class PlasticList final : public PlasticKernel {
  public:
    PlasticList(connectivity::Synapses synapses, int target_cells, const SynapseType& type,
                const SynapseInstance& synapse, Arena& arena);
    void place(Arena& arena, std::vector<Ring> feedback) override;
    void learn(const History& source) override;
    void deliver(const History& source, double* target) override;
    ConstColumn state(std::size_t i) const override { return {states_[i].data(), states_[i].size()}; }
    std::string_view form() const override { return "plastic"; }
    double cost() const override { return 5 * static_cast<double>(size_); }

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
