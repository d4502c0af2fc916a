#include "core/engine/kernels/plastic_by_source.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "core/base/simd.h"
#include "core/engine/finite.h"

namespace forage::engine {
namespace {

FORAGE_SIMD void add_to(const double* from, Index n, double* to) {
    // As wide as the steps between the stretches of sources: what one has stored goes to the next without a
    // detour through the cache.
    constexpr Index lanes = SlidingTargets::lanes;
    typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this
    Index i = 0;
    for (; i + lanes <= n; i += lanes) {
        Lanes sums, more;
        std::memcpy(&sums, to + i, sizeof sums);
        std::memcpy(&more, from + i, sizeof more);
        sums += more;
        std::memcpy(to + i, &sums, sizeof sums);
    }
    for (; i < n; ++i) to[i] += from[i];
}

/// Synapses by the source's rank, and by target.
std::vector<std::size_t> sorted(const connectivity::Synapses& s, const std::vector<int>& cell,
                                int source_cells) {
    std::vector<std::size_t> rank(static_cast<std::size_t>(source_cells)), out(s.size());
    for (std::size_t n = 0; n < cell.size(); ++n) rank[static_cast<std::size_t>(cell[n])] = n;
    std::vector<std::size_t> begin(cell.size() + 1, 0);
    for (const int pre : s.pre) ++begin[rank[static_cast<std::size_t>(pre)] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    auto next = begin;
    for (std::size_t i = 0; i < s.size(); ++i) out[next[rank[static_cast<std::size_t>(s.pre[i])]]++] = i;
    const auto by_target = [&](std::size_t a, std::size_t b) { return s.post[a] < s.post[b]; };
    for (std::size_t n = 0; n < cell.size(); ++n) {
        const auto first = out.begin() + static_cast<std::ptrdiff_t>(begin[n]),
                   last = out.begin() + static_cast<std::ptrdiff_t>(begin[n + 1]);
        if (!std::is_sorted(first, last, by_target)) std::sort(first, last, by_target);
    }
    return out;
}

}  // namespace

PlasticBySource::PlasticBySource(connectivity::Synapses s, const SourceOrder& order, int source_cells,
                                 int target_cells, const SynapseType& type, const SynapseInstance& synapse,
                                 Arena& arena)
    : synapse_(synapse),
      output_(static_cast<std::size_t>(type.output())),
      keeps_outputs_(!type.tells_output),
      adds_outputs_(type.adds_output),
      target_cells_(target_cells),
      sliding_(SlidingTargets::make(order, target_cells)),
      place_(s.size()) {
    if (!sliding_) frame_.emplace(order);
    for (const auto& source : order.sources) cell_.push_back(source.cell);
    first_.push_back(0);
    for (const Stretch& source : stretches())  // each begins with a line of the cache
        first_.push_back(first_.back() + Arena::stride(source.size));
    for (const auto& frame : order.frames) frames_.push_back({frame.first_source, frame.last_source});
    place_synapses(s, source_cells);
    adds_outputs_ &= factor_.empty();
    reserve(type, arena);
}

void PlasticBySource::place_synapses(const connectivity::Synapses& s, int source_cells) {
    factor_.assign(static_cast<std::size_t>(first_.back()), 1.0);
    const auto target_places = sliding_ ? sliding_->take_target_places() : std::vector<int>();
    const auto by_source = sorted(s, cell_, source_cells);
    for (std::size_t n = 0, k = 0; n < cell_.size(); ++n)
        for (const std::size_t begin = k; k < by_source.size() && s.pre[by_source[k]] == cell_[n]; ++k) {
            const std::size_t i = by_source[k];
            place_[i] = first_[n] + (sliding_ ? target_places[k] : static_cast<Index>(k - begin));
            factor_[static_cast<std::size_t>(place_[i])] = s.reference - s.attenuation[i];
        }
    if (std::all_of(factor_.begin(), factor_.end(), [](double f) { return f == 1; }))
        factor_ = std::vector<double>();
}

void PlasticBySource::reserve(const SynapseType& type, Arena& arena) {
    Index largest_frame = sliding_ ? sliding_->places() : 0;
    for (const Stretch& source : stretches()) {
        largest_source_ = std::max(largest_source_, source.size);
        if (!sliding_) largest_frame = std::max(largest_frame, source.place + source.size);
    }
    for (std::size_t i = 0; i < type.states.size(); ++i) {
        state_offsets_.push_back(arena.reserve(kept(i) ? first_.back() : largest_source_));
        initial_.push_back(type.states[i].initial);
    }
    for (std::size_t i = 0; i < type.feedback.size(); ++i)
        gathered_offsets_.push_back(arena.reserve(largest_frame));
    pre_offset_ = arena.reserve(largest_source_);
    sum_offset_ = arena.reserve(target_cells_);
    frame_sum_offset_ = arena.reserve(largest_frame);
    activity_offset_ = arena.reserve(static_cast<Index>(cell_.size()) + 1);
    active_.resize(cell_.size());
}

void PlasticBySource::place(Arena& arena, std::vector<Ring> feedback) {
    feedback_ = std::move(feedback);
    for (std::size_t i = 0; i < state_offsets_.size(); ++i) {
        states_.push_back(arena.at(state_offsets_[i]));
        if (initial_[i] != 0) std::fill_n(states_[i], kept(i) ? first_.back() : largest_source_, initial_[i]);
    }
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        cells_.push_back(nullptr);
        gathered_.push_back(arena.at(gathered_offsets_[f]));
        feedback_columns_.emplace_back(gathered_[f], 0);
    }
    for (double* s : states_) source_states_.emplace_back(s, 0);
    pre_ = arena.at(pre_offset_);
    sums_ = arena.at(sum_offset_);
    frame_sums_ = arena.at(frame_sum_offset_);
    activity_ = arena.at(activity_offset_);
    diverged_ = activity_ + cell_.size();
}

void PlasticBySource::deliver(const History& source, double* target) {
    std::fill_n(sums_, target_cells_, 0.0);
    update(source, sums_);
    add_to(sums_, target_cells_, target);
}

/// Whether synapses may rest. 0 times infinity is NaN: once a number was not finite nobody rests any more.
bool PlasticBySource::read_feedback(std::uint64_t cycle) {
    for (std::size_t f = 0; f < feedback_.size(); ++f) {
        if (!feedback_[f].rows) continue;  // reads 0
        const double* row = feedback_[f].ago(cycle, 0);
        if (*diverged_ == 0 && !all_finite(row, Arena::stride(target_cells_))) *diverged_ = 1;
        cells_[f] = row;
    }
    return *diverged_ == 0;
}

/// The sources whose synapses are updated, by frame; outputs of others become 0.
void PlasticBySource::find_active(const double* source, bool may_rest) {
    std::size_t count = 0;
    double odd = 0;  // x - x is not 0 when x is not finite
    std::size_t* const active = active_.data();
    const int* const cell = cell_.data();
    if (keeps_outputs_)
        for (std::size_t n = 0; n < cell_.size(); ++n)
            if (source[cell[n]] == 0 && activity_[n] != 0)
                std::fill(states_[output_] + first_[n], states_[output_] + first_[n + 1], 0.0);
    // Without branches: who is active cannot be foreseen.
    const std::size_t always = may_rest ? 0 : 1;
    for (std::size_t n = 0; n < cell_.size(); ++n) {
        const double activity = source[cell[n]];
        activity_[n] = activity;
        odd += activity - activity;
        active[count] = n;
        count += static_cast<std::size_t>(activity != 0) | always;
    }
    active_count_ = count;
    if (odd != 0) *diverged_ = 1;  // what the synapses learn from it stays when their source falls silent
}

void PlasticBySource::update(const History& source, double* sums) {
    find_active(source.now, read_feedback(source.cycle));
    if (active_count_ == 0) return;
    const std::size_t* next = active_.data();
    const std::size_t* const last = next + active_count_;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
        const std::size_t* first = next;
        while (next != last && *next < frames_[f].last_source) ++next;
        if (sliding_) {
            slide_into(f, sums);
            update_sliding(first, next, sums != nullptr);
        } else if (next != first) {
            update_frame(f, first, next, sums);
        }
    }
    if (sliding_) slide_into(frames_.size(), sums);
}

void PlasticBySource::slide_into(std::size_t frame, double* sums) {
    const auto leaving = sliding_->leaving(frame), entering = sliding_->entering(frame);
    if (sums) {
        for (const auto [target, place] : leaving) sums[target] = frame_sums_[place];
        for (const auto [target, place] : entering) frame_sums_[place] = sums[target];
    }
    for (std::size_t f = 0; f < feedback_.size(); ++f)
        if (const double* cells = cells_[f])
            for (const auto [target, place] : entering) gathered_[f][place] = cells[target];
}

/// Updates some sources of the frame that is there.
void PlasticBySource::update_sliding(const std::size_t* first, const std::size_t* last, bool sums) {
    for (const std::size_t* n = first; n != last; ++n) {
        const Stretch stretch = sliding_->sources()[*n];
        if (sums)
            update_and_add(*n, stretch.place);
        else
            update_source(*n, stretch.place);
    }
}

/// Updates some sources of a frame.
void PlasticBySource::update_frame(std::size_t frame, const std::size_t* first, const std::size_t* last,
                                   double* sums) {
    Stretch part = stretches()[*first];  // what they reach of it
    for (const std::size_t* n = first + 1; n != last; ++n) {
        const Stretch source = stretches()[*n];
        const Index end = std::max(part.place + part.size, source.place + source.size);
        part.place = std::min(part.place, source.place);
        part.size = end - part.place;
    }
    for (std::size_t f = 0; f < feedback_.size(); ++f)
        if (cells_[f]) frame_->gather(frame, part, cells_[f], gathered_[f]);
    const bool one = last - first == 1;
    if (sums && !one) frame_->gather(frame, part, sums, frame_sums_);
    for (const std::size_t* n = first; n != last; ++n) {
        const Stretch source = stretches()[*n];
        const Index place = source.place - part.place;
        if (sums && !one)
            update_and_add(*n, place);
        else if (const double* psp = update_source(*n, place); sums)
            frame_->add(frame, part, psp, sums);
    }
    if (sums && !one) frame_->scatter(frame, part, frame_sums_, sums);
}

/// All synapses of the n-th source, whose feedback begins at `place` of what is gathered; gives their
/// outputs.
const double* PlasticBySource::update_source(std::size_t n, Index place) {
    SynapseColumns seen = columns(n, place, nullptr);
    synapse_.update(seen);
    return attenuated(n);
}

/// The same; they are added to the sums there.
void PlasticBySource::update_and_add(std::size_t n, Index place) {
    double* const sums = frame_sums_ + place;
    if (!adds_outputs_) return add_to(update_source(n, place), stretches()[n].size, sums);
    SynapseColumns seen = columns(n, place, sums);
    synapse_.update_and_add(seen);
}

/// What an update of the n-th source sees.
SynapseColumns PlasticBySource::columns(std::size_t n, Index place, double* sums) {
    const Index size = look_at(n);
    for (std::size_t f = 0; f < feedback_.size(); ++f)
        new (&feedback_columns_[f]) ConstColumn(gathered_[f] + place, size);
    return {ConstColumn(pre_, size), source_states_, feedback_columns_, sums};
}

/// Lets `pre_` and `source_states_` be those of the n-th source; gives its number of places.
Index PlasticBySource::look_at(std::size_t n) const {
    const Index size = stretches()[n].size;
    if (std::bit_cast<std::uint64_t>(pre_[0]) != std::bit_cast<std::uint64_t>(activity_[n]))
        std::fill_n(pre_, largest_source_, activity_[n]);  // spikes are alike
    for (std::size_t s = 0; s < states_.size(); ++s)
        new (&source_states_[s]) Column(states_[s] + (kept(s) ? first_[n] : 0), size);
    return size;
}

const double* PlasticBySource::attenuated(std::size_t n) const {
    Column& output = source_states_[output_];
    if (!factor_.empty()) output *= ConstColumn(&factor_[static_cast<std::size_t>(first_[n])], output.size());
    return output.data();
}

/// Tells outputs that are not kept.
std::vector<double> PlasticBySource::outputs() const {
    const std::vector<ConstColumn> no_feedback;
    std::vector<double> out(static_cast<std::size_t>(first_.back()), 0.0);
    for (std::size_t n = 0; n < cell_.size(); ++n) {
        if (activity_[n] == 0 && *diverged_ == 0) continue;
        const Index size = look_at(n);
        SynapseColumns columns(ConstColumn(pre_, size), source_states_, no_feedback);
        synapse_.output(columns);
        std::copy_n(attenuated(n), size, out.begin() + first_[n]);
    }
    return out;
}

ConstColumn PlasticBySource::state(std::size_t i) const {
    const auto told = kept(i) ? std::vector<double>() : outputs();
    const double* all = kept(i) ? states_[i] : told.data();
    shown_.resize(place_.size());
    for (std::size_t k = 0; k < shown_.size(); ++k) shown_[k] = all[place_[k]];
    return {shown_.data(), static_cast<Index>(shown_.size())};
}

}  // namespace forage::engine
