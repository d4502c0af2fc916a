#include "core/engine/plastic_kernel.h"

#include <algorithm>

namespace forage::engine {

PlasticKernel::PlasticKernel(connectivity::Synapses synapses, int target_cells, const SynapseType& type,
                             const SynapseInstance& synapse, Arena& arena)
    : s_(std::move(synapses)), type_(type), synapse_(synapse), size_(static_cast<Index>(s_.size())),
      longest_(*std::max_element(s_.delay.begin(), s_.delay.end())), target_cells_(target_cells) {
    for (std::size_t i = 0; i < type.states.size(); ++i) state_offsets_.push_back(arena.reserve(size_));
    for (std::size_t i = 0; i < type.feedback.size(); ++i) feedback_offsets_.push_back(arena.reserve(size_));
    pre_offset_ = arena.reserve(size_);
    psp_offset_ = arena.reserve(size_, longest_ + 1);
    sum_offset_ = arena.reserve(target_cells_);
}

void PlasticKernel::place(Arena& arena, std::vector<Feedback> feedback) {
    feedback_ = std::move(feedback);
    for (const auto offset : state_offsets_) states_.emplace_back(arena.at(offset), size_);
    for (const auto offset : feedback_offsets_) {
        gathered_.push_back(arena.at(offset));
        feedback_columns_.emplace_back(arena.at(offset), size_);
    }
    pre_ = arena.at(pre_offset_);
    psp_ring_ = arena.at(psp_offset_);
    sums_ = arena.at(sum_offset_);
}

void PlasticKernel::deliver(const History& source, double* target) {
    const auto n = s_.size();
    for (std::size_t i = 0; i < n; ++i) pre_[i] = source.now[s_.pre[i]];
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        if (!feedback_[f].ring) continue;  // an optional input that the file leaves unset reads 0
        for (std::size_t i = 0; i < n; ++i) gathered_[f][i] = feedback_[f].ago(source.cycle, s_.delay[i])[s_.post[i]];
    }
    SynapseColumns columns(ConstColumn(pre_, size_), states_, feedback_columns_);
    synapse_.update(columns);

    const auto depth = static_cast<std::uint64_t>(longest_) + 1;
    const Index stride = Arena::stride(size_);
    const auto row = [&](int delay) {
        return psp_ring_ + static_cast<Index>((source.cycle + depth - static_cast<std::uint64_t>(delay)) % depth) * stride;
    };
    double* now = row(0);
    Column& psp = states_[static_cast<std::size_t>(type_.output())];
    for (std::size_t i = 0; i < n; ++i) {
        psp[static_cast<Index>(i)] *= s_.reference - s_.attenuation[i];
        now[i] = psp[static_cast<Index>(i)];
    }
    std::fill_n(sums_, target_cells_, 0.0);
    for (std::size_t i = 0; i < n; ++i) sums_[s_.post[i]] += row(s_.delay[i])[i];
    Column(target, target_cells_) += ConstColumn(sums_, target_cells_);
}

}  // namespace forage::engine
