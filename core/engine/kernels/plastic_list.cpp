#include "core/engine/kernels/plastic_list.h"

#include <algorithm>

namespace forage::engine {

PlasticList::PlasticList(connectivity::Synapses s, int target_cells, const SynapseType& type,
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
    for (const auto& state : type.states) {
        state_offsets_.push_back(arena.reserve(size_));
        initial_.push_back(state.initial);
    }
    const Index part = std::min(size_, block);
    for (std::size_t i = 0; i < type.feedback.size(); ++i) feedback_offsets_.push_back(arena.reserve(part));
    pre_offset_ = arena.reserve(part);
    if (longest_ > 0) psp_offset_ = arena.reserve(size_, longest_ + 1);
    sum_offset_ = arena.reserve(target_cells_);
    feedback_rows_.resize(static_cast<std::size_t>(longest_) + 1);
    psp_rows_.resize(static_cast<std::size_t>(longest_) + 1);
}

void PlasticList::place(Arena& arena, std::vector<Ring> feedback) {
    feedback_ = std::move(feedback);
    for (std::size_t i = 0; i < state_offsets_.size(); ++i) {
        states_.emplace_back(arena.at(state_offsets_[i]), size_);
        if (initial_[i] != 0) states_[i].setConstant(initial_[i]);
    }
    for (const auto offset : feedback_offsets_) {
        gathered_.push_back(arena.at(offset));
        feedback_columns_.emplace_back(arena.at(offset), std::min(size_, block));
    }
    for (Column& s : states_) block_states_.emplace_back(s.data(), s.size());
    pre_ = arena.at(pre_offset_);
    if (longest_ > 0) psp_ring_ = arena.at(psp_offset_);
    sums_ = arena.at(sum_offset_);
}

void PlasticList::learn(const History& source) {
    for (Index first = 0; first < size_; first += block)
        learn_block(source, first, std::min(block, size_ - first));
}

void PlasticList::learn_block(const History& source, Index first, Index size) {
    const int *pre = &pre_cell_[static_cast<std::size_t>(first)],
              *post = &post_cell_[static_cast<std::size_t>(first)],
              *delay = &delay_[static_cast<std::size_t>(first)];
    for (Index i = 0; i < size; ++i) pre_[i] = source.now[pre[i]];
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        double* gathered = gathered_[f];
        new (&feedback_columns_[f]) ConstColumn(gathered, size);
        if (!feedback_[f].rows) continue;  // reads 0
        if (longest_ == 0) {
            const double* row = feedback_[f].ago(source.cycle, 0);
            for (Index i = 0; i < size; ++i) gathered[i] = row[post[i]];
        } else {
            feedback_[f].tabulate(source.cycle, feedback_rows_);
            for (Index i = 0; i < size; ++i)
                gathered[i] = feedback_rows_[static_cast<std::size_t>(delay[i])][post[i]];
        }
    }
    for (std::size_t s = 0; s < states_.size(); ++s)
        new (&block_states_[s]) Column(states_[s].data() + first, size);
    SynapseColumns columns(ConstColumn(pre_, size), block_states_, feedback_columns_);
    synapse_.update(columns);
    block_states_[output_] *= ConstColumn(factor_.data() + first, size);
}

/// Without delays; a target's synapses often follow each other, and their sum then stays in a register.
void PlasticList::sum_now(double* sums) const {
    const double* psp = states_[output_].data();
    const auto n = post_cell_.size();
    for (std::size_t i = 0; i < n;) {
        const int target = post_cell_[i];
        double sum = sums[target];
        for (; i < n && post_cell_[i] == target; ++i) sum += psp[i];
        sums[target] = sum;
    }
}

void PlasticList::deliver(const History& source, double* target) {
    learn(source);
    const double* psp = states_[output_].data();
    const auto n = pre_cell_.size();
    std::fill_n(sums_, target_cells_, 0.0);
    if (longest_ == 0) {
        sum_now(sums_);
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
