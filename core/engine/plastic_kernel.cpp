#include "core/engine/plastic_kernel.h"

#include <algorithm>

namespace forage::engine {

PlasticKernel::PlasticKernel(connectivity::Synapses s, int target_cells, const SynapseType& type,
                             const SynapseInstance& synapse, Arena& arena)
    : synapse_(synapse),
      output_(static_cast<std::size_t>(type.output())),
      pre_cell_(std::move(s.pre)),
      post_cell_(std::move(s.post)),
      delay_(std::move(s.delay)),
      factor_(std::move(s.attenuation)),
      longest_(*std::max_element(delay_.begin(), delay_.end())),
      size_(static_cast<Index>(pre_cell_.size())),
      target_cells_(target_cells) {
    for (double& f : factor_) f = s.reference - f;
    for (std::size_t i = 0; i < type.states.size(); ++i) state_offsets_.push_back(arena.reserve(size_));
    for (std::size_t i = 0; i < type.feedback.size(); ++i) feedback_offsets_.push_back(arena.reserve(size_));
    pre_offset_ = arena.reserve(size_);
    if (longest_ > 0) psp_offset_ = arena.reserve(size_, longest_ + 1);
    sum_offset_ = arena.reserve(target_cells_);
    feedback_rows_.resize(static_cast<std::size_t>(longest_) + 1);
    psp_rows_.resize(static_cast<std::size_t>(longest_) + 1);
}

void PlasticKernel::place(Arena& arena, std::vector<Ring> feedback) {
    feedback_ = std::move(feedback);
    for (const auto offset : state_offsets_) states_.emplace_back(arena.at(offset), size_);
    for (const auto offset : feedback_offsets_) {
        gathered_.push_back(arena.at(offset));
        feedback_columns_.emplace_back(arena.at(offset), size_);
    }
    pre_ = arena.at(pre_offset_);
    if (longest_ > 0) psp_ring_ = arena.at(psp_offset_);
    sums_ = arena.at(sum_offset_);
}

void PlasticKernel::learn(const History& source) {
    const auto n = pre_cell_.size();
    for (std::size_t i = 0; i < n; ++i) pre_[i] = source.now[pre_cell_[i]];
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        if (!feedback_[f].rows) continue;
        feedback_[f].tabulate(source.cycle, feedback_rows_);
        double* gathered = gathered_[f];
        for (std::size_t i = 0; i < n; ++i)
            gathered[i] = feedback_rows_[static_cast<std::size_t>(delay_[i])][post_cell_[i]];
    }
    SynapseColumns columns(ConstColumn(pre_, size_), states_, feedback_columns_);
    synapse_.update(columns);
    states_[output_] *= ConstColumn(factor_.data(), size_);
}

void PlasticKernel::deliver(const History& source, double* target) {
    learn(source);
    const double* psp = states_[output_].data();
    const auto n = pre_cell_.size();
    std::fill_n(sums_, target_cells_, 0.0);
    if (longest_ == 0) {
        for (std::size_t i = 0; i < n; ++i) sums_[post_cell_[i]] += psp[i];
    } else {
        const Ring ring{psp_ring_, std::int64_t{longest_} + 1, Arena::stride(size_)};
        ring.tabulate(source.cycle, psp_rows_);
        const auto now = static_cast<Index>(source.cycle % static_cast<std::uint64_t>(ring.depth));
        std::copy_n(psp, n, psp_ring_ + now * ring.stride);
        for (std::size_t i = 0; i < n; ++i)
            sums_[post_cell_[i]] += psp_rows_[static_cast<std::size_t>(delay_[i])][i];
    }
    Column(target, target_cells_) += ConstColumn(sums_, target_cells_);
}

}  // namespace forage::engine
