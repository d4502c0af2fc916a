// Plastic synapses that rest while their source is silent, laid out by their source.
#pragma once

#include <optional>
#include <vector>

#include "core/engine/kernels/plastic_kernel.h"
#include "core/engine/kernels/sliding_targets.h"
#include "core/engine/kernels/source_order.h"
#include "core/engine/kernels/target_frame.h"

namespace forage::engine {

/// A cycle updates and delivers the synapses of active sources only. The type has promised that the others
/// would change nothing: SynapseSpec::event_driven(). Feedback and sums are copied into a column for
/// each frame of targets, or where frames overlap, for each target; an update sees a stretch of it. Outputs
/// are kept only where the type cannot tell them again.
class PlasticBySource final : public PlasticKernel {
  public:
    PlasticBySource(connectivity::Synapses synapses, const SourceOrder& order, int source_cells,
                    int target_cells, const SynapseType& type, const SynapseInstance& synapse, Arena& arena);
    void place(Arena& arena, std::vector<Ring> feedback) override;
    void learn(const History& source) override { update(source, nullptr); }
    void deliver(const History& source, double* target) override;
    ConstColumn state(std::size_t i) const override;
    std::string_view form() const override { return "plastic by source"; }
    double cost() const override { return 0.3 * static_cast<double>(place_.size()); }

  private:
    struct Frame {
        std::size_t first_source, last_source;
    };
    bool kept(std::size_t state) const { return keeps_outputs_ || state != output_; }
    const std::vector<Stretch>& stretches() const {
        return sliding_ ? sliding_->sources() : frame_->sources();
    }
    void place_synapses(const connectivity::Synapses& synapses, int source_cells);
    void reserve(const SynapseType& type, Arena& arena);
    bool read_feedback(std::uint64_t cycle);
    void find_active(const double* source, bool may_rest);
    void update(const History& source, double* sums);
    void update_frame(std::size_t frame, const std::size_t* first, const std::size_t* last, double* sums);
    void slide_into(std::size_t frame, double* sums);
    void update_sliding(const std::size_t* first, const std::size_t* last, bool sums);
    SynapseColumns columns(std::size_t n, Index place, double* sums);
    const double* update_source(std::size_t n, Index place);
    void update_and_add(std::size_t n, Index place);
    Index look_at(std::size_t n) const;
    const double* attenuated(std::size_t n) const;
    std::vector<double> outputs() const;

    const SynapseInstance& synapse_;
    std::size_t output_;  ///< index of the output state
    bool keeps_outputs_;  ///< else the type tells them
    bool adds_outputs_;   ///< ... and adds them to the sums
    Index target_cells_;
    std::optional<SlidingTargets> sliding_;
    std::optional<TargetFrame> frame_;  ///< without `sliding_`
    std::vector<Frame> frames_;
    std::vector<int> cell_;        ///< of the n-th source
    std::vector<Index> first_;     ///< place of its first synapse; one more than there are
    Index largest_source_ = 0;     ///< places
    std::vector<double> factor_;   ///< reference - attenuation, by place; empty when all are 1
    std::vector<Index> place_;     ///< of the synapses, in synapse order
    std::vector<double> initial_;  ///< of the states

    Arena::Offset pre_offset_, sum_offset_, frame_sum_offset_, activity_offset_;
    std::vector<Arena::Offset> state_offsets_, gathered_offsets_;
    double *sums_ = nullptr, *frame_sums_ = nullptr;  ///< per target cell, and per place of a frame
    double* activity_ = nullptr;                      ///< of the sources, at the last update
    double* diverged_ = nullptr;       ///< 1 once a number that the synapses read was not finite
    std::vector<std::size_t> active_;  ///< of this cycle: the first `active_count_`
    std::size_t active_count_ = 0;
    std::vector<Ring> feedback_;
    std::vector<const double*> cells_;  ///< feedback of this cycle, per target cell; null: reads 0
    std::vector<double*> gathered_;     ///< the same, per place of a frame
    std::vector<double*> states_;       ///< of all synapses; of one source, when it is not kept

    // What an update is shown, of one source.
    double* pre_ = nullptr;
    mutable std::vector<Column> source_states_;
    std::vector<ConstColumn> feedback_columns_;
    mutable std::vector<double> shown_;  ///< what state() gave last
};

}  // namespace forage::engine
