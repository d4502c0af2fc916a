// Connections whose synapses have a state of their own or read their target: types with an update().
#pragma once

#include "core/engine/arena.h"
#include "core/engine/kernel.h"

namespace forage::engine {

/// A state of the target that the synapses read: its ring of rows.
struct Feedback {
    const double* ring;
    std::int64_t depth, stride;
    const double* ago(std::uint64_t cycle, int delay) const {
        const auto row = static_cast<std::int64_t>(cycle % static_cast<std::uint64_t>(depth));
        return ring + ((row - delay + depth) % depth) * stride;
    }
};

class PlasticKernel final : public Kernel {
  public:
    /// Reserves the synapses' states in `arena`.
    PlasticKernel(connectivity::Synapses synapses, int target_cells, const SynapseType& type, const SynapseInstance& synapse,
                  Arena& arena);
    /// Once, after the arena is allocated.
    void place(Arena& arena, std::vector<Feedback> feedback);

    void deliver(const History& source, double* target) override;
    std::string_view form() const override { return "plastic"; }

    int longest_delay() const { return longest_; }
    /// State `i` of the type, per synapse in synapse order. The output state is what was computed in this cycle,
    /// attenuated.
    ConstColumn state(std::size_t i) const { return {states_[i].data(), states_[i].size()}; }

  private:
    connectivity::Synapses s_;
    const SynapseType& type_;
    const SynapseInstance& synapse_;
    Index size_;
    int longest_;
    std::vector<Arena::Offset> state_offsets_, feedback_offsets_;
    Arena::Offset pre_offset_, psp_offset_, sum_offset_;
    Index target_cells_;

    double* pre_ = nullptr;
    double* psp_ring_ = nullptr;  ///< attenuated output of the last longest_ + 1 cycles
    double* sums_ = nullptr;
    std::vector<double*> gathered_;
    std::vector<Feedback> feedback_;
    std::vector<Column> states_;
    std::vector<ConstColumn> feedback_columns_;
};

}  // namespace forage::engine
