// Plastic synapses that rest while their source is silent, laid out by their source.
#pragma once

#include <vector>

#include "core/engine/plastic_kernel.h"

namespace forage::engine {

/// The source cells of a connection in an order in which every target can sum its synapses in synapse order:
/// one source after the other. Empty when there is none, when there are delays, or when the sources have too
/// few synapses each for an update of their own (below 8 on average).
std::vector<int> order_of_sources(const connectivity::Synapses& synapses, int source_cells, int target_cells);

/// A cycle updates and delivers the synapses of active sources only. The type has promised that the others
/// would change nothing: SynapseSpec::rests_when_silent().
class PlasticBySource final : public PlasticKernel {
  public:
    /// `order`: as order_of_sources() gives it.
    PlasticBySource(connectivity::Synapses synapses, std::vector<int> order, int target_cells,
                    const SynapseType& type, const SynapseInstance& synapse, Arena& arena);
    void place(Arena& arena, std::vector<Ring> feedback) override;
    void learn(const History& source) override { update(source, nullptr); }
    void deliver(const History& source, double* target) override;
    ConstColumn state(std::size_t i) const override;
    std::string_view form() const override { return "plastic by source"; }
    double cost() const override { return static_cast<double>(size_); }

  private:
    bool may_rest();
    void update(const History& source, double* sums);
    /// All synapses of the `n`-th source.
    void update_source(std::size_t n, double activity);
    void fetch(std::size_t n) const;

    const SynapseInstance& synapse_;
    std::size_t output_;  ///< index of the output state
    Index size_, target_cells_;
    std::vector<int> order_;       ///< sources that have synapses
    std::vector<Index> start_;     ///< of the synapses of the n-th of them; one more than there are
    std::vector<int> post_;        ///< target cells, by source
    std::vector<double> factor_;   ///< reference - attenuation, by source; empty when all are 1
    std::vector<Index> place_;     ///< where the synapses are, in synapse order
    std::vector<double> initial_;  ///< of the states

    Arena::Offset pre_offset_, sum_offset_, quiet_offset_;
    std::vector<Arena::Offset> state_offsets_, feedback_offsets_;
    double *pre_ = nullptr, *sums_ = nullptr;
    double* quiet_ = nullptr;          ///< per source: 1 when its outputs are 0 already
    double* diverged_ = nullptr;       ///< 1 once a number that the synapses read was not finite
    std::vector<std::size_t> active_;  ///< of this cycle
    std::vector<double*> gathered_;    ///< feedback, per synapse of a source
    std::vector<Ring> feedback_;
    std::vector<const double*> feedback_rows_;    ///< of this cycle; null for an unset one
    std::vector<Column> states_, source_states_;  ///< of all synapses, and of a source
    std::vector<ConstColumn> feedback_columns_;
    mutable std::vector<double> shown_;  ///< what state() gave last
};

}  // namespace forage::engine
