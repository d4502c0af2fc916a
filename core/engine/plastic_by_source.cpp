#include "core/engine/plastic_by_source.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/engine/finite.h"
#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr std::size_t least_synapses = 8;  ///< per source: below, an update for each costs more than it saves

FORAGE_SIMD void gather(const double* row, const int* cells, Index n, double* out) {
    for (Index i = 0; i < n; ++i) out[i] = row[cells[i]];
}

}  // namespace

/// Synapses that follow each other at a target say which source comes before which (Kahn 1962, "Topological
/// sorting of large networks").
std::vector<int> order_of_sources(const connectivity::Synapses& s, int source_cells, int target_cells) {
    const auto sources = static_cast<std::size_t>(source_cells);
    if (s.size() < least_synapses * sources ||
        std::any_of(s.delay.begin(), s.delay.end(), [](int delay) { return delay != 0; }))
        return {};
    // Edges from each source to the next one at some target, listed by where they begin.
    std::vector<int> last(static_cast<std::size_t>(target_cells), -1), from(s.size(), -1);
    std::vector<std::size_t> begin(sources + 1, 0);
    for (std::size_t i = 0; i < s.size(); ++i) {
        int& before = last[static_cast<std::size_t>(s.post[i])];
        from[i] = before;
        if (before >= 0) ++begin[static_cast<std::size_t>(before) + 1];
        before = s.pre[i];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<int> next(begin.back()), waits_for(sources, 0);
    auto free = begin;
    for (std::size_t i = 0; i < s.size(); ++i)
        if (from[i] >= 0) {
            next[free[static_cast<std::size_t>(from[i])]++] = s.pre[i];
            ++waits_for[static_cast<std::size_t>(s.pre[i])];
        }
    std::vector<int> order;
    for (int source = 0; source < source_cells; ++source)
        if (waits_for[static_cast<std::size_t>(source)] == 0) order.push_back(source);
    for (std::size_t done = 0; done < order.size(); ++done) {
        const auto source = static_cast<std::size_t>(order[done]);
        for (std::size_t e = begin[source]; e < begin[source + 1]; ++e)
            if (--waits_for[static_cast<std::size_t>(next[e])] == 0) order.push_back(next[e]);
    }
    if (order.size() < sources) order.clear();  // they go round in a circle
    return order;
}

PlasticBySource::PlasticBySource(connectivity::Synapses s, std::vector<int> order, int target_cells,
                                 const SynapseType& type, const SynapseInstance& synapse, Arena& arena)
    : synapse_(synapse),
      output_(static_cast<std::size_t>(type.output())),
      size_(static_cast<Index>(s.size())),
      target_cells_(target_cells),
      order_(std::move(order)),
      post_(s.size()),
      factor_(s.size()),
      place_(s.size()) {
    std::vector<Index> count(order_.size(), 0);
    for (const int pre : s.pre) ++count[static_cast<std::size_t>(pre)];
    std::erase_if(order_, [&](int source) { return count[static_cast<std::size_t>(source)] == 0; });
    start_.push_back(0);
    std::vector<Index> next(count.size());
    for (const int source : order_) {
        next[static_cast<std::size_t>(source)] = start_.back();
        start_.push_back(start_.back() + count[static_cast<std::size_t>(source)]);
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Index at = place_[i] = next[static_cast<std::size_t>(s.pre[i])]++;
        post_[static_cast<std::size_t>(at)] = s.post[i];
        factor_[static_cast<std::size_t>(at)] = s.reference - s.attenuation[i];
    }
    const Index most = *std::max_element(count.begin(), count.end());
    for (const auto& state : type.states) {
        state_offsets_.push_back(arena.reserve(size_));
        initial_.push_back(state.initial);
    }
    for (std::size_t i = 0; i < type.feedback.size(); ++i) feedback_offsets_.push_back(arena.reserve(most));
    pre_offset_ = arena.reserve(most);
    sum_offset_ = arena.reserve(target_cells_);
    quiet_offset_ = arena.reserve(static_cast<Index>(order_.size()) + 1);
    active_.reserve(order_.size());
    if (std::all_of(factor_.begin(), factor_.end(), [](double f) { return f == 1; }))
        factor_ = std::vector<double>();
    feedback_rows_.resize(type.feedback.size());
}

void PlasticBySource::place(Arena& arena, std::vector<Ring> feedback) {
    feedback_ = std::move(feedback);
    for (std::size_t i = 0; i < state_offsets_.size(); ++i) {
        states_.emplace_back(arena.at(state_offsets_[i]), size_);
        if (initial_[i] != 0) states_[i].setConstant(initial_[i]);
    }
    for (const auto offset : feedback_offsets_) {
        gathered_.push_back(arena.at(offset));
        feedback_columns_.emplace_back(arena.at(offset), 0);
    }
    for (Column& s : states_) source_states_.emplace_back(s.data(), s.size());
    pre_ = arena.at(pre_offset_);
    sums_ = arena.at(sum_offset_);
    quiet_ = arena.at(quiet_offset_);
    diverged_ = quiet_ + order_.size();
}

void PlasticBySource::deliver(const History& source, double* target) {
    std::fill_n(sums_, target_cells_, 0.0);
    update(source, sums_);
    Column(target, target_cells_) += ConstColumn(sums_, target_cells_);
}

/// 0 times infinity is NaN: once a number was not finite nobody rests any more.
bool PlasticBySource::may_rest() {
    for (std::size_t f = 0; f < feedback_.size() && *diverged_ == 0; ++f)
        if (feedback_rows_[f] && !all_finite(feedback_rows_[f], Arena::stride(target_cells_))) *diverged_ = 1;
    return *diverged_ == 0;
}

void PlasticBySource::update(const History& source, double* sums) {
    for (std::size_t f = 0; f < feedback_.size(); ++f)
        feedback_rows_[f] = feedback_[f].rows ? feedback_[f].ago(source.cycle, 0) : nullptr;
    const bool may_rest = this->may_rest();
    active_.clear();
    for (std::size_t n = 0; n < order_.size(); ++n) {
        if (source.now[order_[n]] != 0 || !may_rest) {
            quiet_[n] = 0;
            active_.push_back(n);
        } else if (quiet_[n] == 0) {
            states_[output_].segment(start_[n], start_[n + 1] - start_[n]).setZero();
            quiet_[n] = 1;
        }
    }
    for (std::size_t i = 0; i < active_.size(); ++i) {
        if (i + 2 < active_.size()) fetch(active_[i + 2]);
        const std::size_t n = active_[i];
        update_source(n, source.now[order_[n]]);
        if (!sums) continue;
        const int* post = &post_[static_cast<std::size_t>(start_[n])];
        const double* psp = states_[output_].data() + start_[n];
        const Index size = start_[n + 1] - start_[n];
        for (Index k = 0; k < size; ++k) sums[post[k]] += psp[k];
    }
}

/// Active sources lie apart: the processor does not guess which is next.
void PlasticBySource::fetch(std::size_t n) const {
    constexpr Index line = 8;  // numbers
    for (const Column& state : states_)
        for (Index i = start_[n]; i < start_[n + 1]; i += line) __builtin_prefetch(state.data() + i);
    for (Index i = start_[n]; i < start_[n + 1]; i += 2 * line)
        __builtin_prefetch(&post_[static_cast<std::size_t>(i)]);
}

void PlasticBySource::update_source(std::size_t n, double activity) {
    const Index first = start_[n], size = start_[n + 1] - first;
    std::fill_n(pre_, size, activity);
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        new (&feedback_columns_[f]) ConstColumn(gathered_[f], size);
        if (feedback_rows_[f])
            gather(feedback_rows_[f], &post_[static_cast<std::size_t>(first)], size, gathered_[f]);
    }
    for (std::size_t s = 0; s < states_.size(); ++s)
        new (&source_states_[s]) Column(states_[s].data() + first, size);
    SynapseColumns columns(ConstColumn(pre_, size), source_states_, feedback_columns_);
    synapse_.update(columns);
    if (!factor_.empty()) source_states_[output_] *= ConstColumn(factor_.data() + first, size);
}

ConstColumn PlasticBySource::state(std::size_t i) const {
    shown_.resize(static_cast<std::size_t>(size_));
    for (std::size_t k = 0; k < shown_.size(); ++k) shown_[k] = states_[i][place_[k]];
    return {shown_.data(), size_};
}

}  // namespace forage::engine
