#include "core/engine/sliced_kernel.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/types/simd.h"

namespace forage::engine {
namespace {

constexpr std::size_t lanes = 8;

/// Targets by number of synapses, the longest first; else in order.
std::vector<int> by_length(const ByTarget& s) {
    std::vector<int> order(s.targets());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return s.length(static_cast<std::size_t>(a)) > s.length(static_cast<std::size_t>(b));
    });
    return order;
}

std::size_t padded(const ByTarget& s) {
    const auto order = by_length(s);
    std::size_t sum = 0;
    for (std::size_t t = 0; t < order.size(); t += lanes)
        sum += lanes * static_cast<std::size_t>(s.length(static_cast<std::size_t>(order[t])));
    return sum;
}

std::vector<int> delays_of(const ByTarget& s) {
    std::vector<int> out;
    for (const int d : s.delay)
        if (std::find(out.begin(), out.end(), d) == out.end()) {
            out.push_back(d);
            if (out.size() > 16) break;
        }
    return out;
}

typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this

/// Where the k-th synapses of a slice's targets are.
template <class Cell>
struct Place {
    const Cell* pre;
    const double* weight;  ///< null when all are alike
};

/// sums[l] += what the k-th synapse of target l delivers.
template <class Cell, bool weighted>
[[gnu::always_inline]] inline void add_synapse(const Place<Cell>& place, std::size_t k, const double* scaled,
                                               Lanes& sums) {
    constexpr std::size_t ahead =
        512;  // numbers; beyond the page, where the processor does not look by itself
    const Cell* pre = place.pre + k * lanes;
    double values[lanes];
    for (std::size_t l = 0; l < lanes; ++l) values[l] = scaled[pre[l]];
    Lanes psp;
    std::memcpy(&psp, values, sizeof psp);
    if constexpr (weighted) {
        Lanes weight;
        std::memcpy(&weight, place.weight + k * lanes, sizeof weight);
        __builtin_prefetch(place.weight + k * lanes + ahead);
        psp *= weight;
    }
    if (k % (64 / (lanes * sizeof(Cell))) == 0) __builtin_prefetch(pre + ahead);
    sums += psp;
}

constexpr std::size_t together = 4;  ///< slices

/// The sums of some slices, the longest first, side by side: their targets read about the same sources at the
/// same time, and more loads are under way.
template <std::size_t count, bool weighted, class Cell>
[[gnu::always_inline]] inline void sum_slices(const Place<Cell>* places, const std::size_t* lengths,
                                              const double* scaled, double* out) {
    Lanes sums[count];
    for (std::size_t j = 0; j < count; ++j) sums[j] = Lanes{};
    for (std::size_t k = 0; k < lengths[count - 1]; ++k)
        for (std::size_t j = 0; j < count; ++j) add_synapse<Cell, weighted>(places[j], k, scaled, sums[j]);
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t k = lengths[count - 1]; k < lengths[j]; ++k)
            add_synapse<Cell, weighted>(places[j], k, scaled, sums[j]);
        std::memcpy(out + j * lanes, &sums[j], sizeof sums[j]);
    }
}

template <class Cell>
[[gnu::always_inline]] inline void sum_any(const Place<Cell>* places, const std::size_t* lengths,
                                           std::size_t count, const double* scaled, double* out) {
    const bool weighted = places->weight;
    if (count == together && weighted)
        sum_slices<together, true>(places, lengths, scaled, out);
    else if (count == together)
        sum_slices<together, false>(places, lengths, scaled, out);
    else if (weighted)
        sum_slices<1, true>(places, lengths, scaled, out);
    else
        sum_slices<1, false>(places, lengths, scaled, out);
}

FORAGE_SIMD void sum(const Place<std::uint16_t>* places, const std::size_t* lengths, std::size_t count,
                     const double* scaled, double* out) {
    sum_any(places, lengths, count, scaled, out);
}
FORAGE_SIMD void sum(const Place<std::uint32_t>* places, const std::size_t* lengths, std::size_t count,
                     const double* scaled, double* out) {
    sum_any(places, lengths, count, scaled, out);
}

FORAGE_SIMD void scale(const double* from, double gain, double factor, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] * gain * factor;
}

FORAGE_SIMD void scale(const double* from, double gain, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] * gain;
}

}  // namespace

template <class Cell>
SlicedKernel<Cell>::SlicedKernel(ByTarget s, std::vector<int> delays, int source_cells,
                                 const SynapseInstance& synapse)
    : synapse_(synapse),
      source_cells_(static_cast<std::size_t>(source_cells)),
      targets_(s.targets()),
      delays_(std::move(delays)),
      scaled_(delays_.size() * source_cells_ + 1),
      factor_(s.factor[0]) {
    const bool same = std::all_of(s.factor.begin(), s.factor.end(), [&](double f) { return f == factor_; });
    target_ = by_length(s);
    const std::size_t count = (targets_ + lanes - 1) / lanes, cells = padded(s);
    target_.resize(count * lanes, -1);
    pre_.assign(cells, static_cast<Cell>(scaled_.size() - 1));
    if (!same) weight_.assign(cells, 0.0);
    std::size_t first = 0;
    for (std::size_t slice = 0; slice < count; ++slice) {
        const auto length =
            static_cast<std::size_t>(s.length(static_cast<std::size_t>(target_[slice * lanes])));
        if (length == 0) break;  // and so are all that follow
        slices_.push_back({first, length});
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (target_[slice * lanes + lane] < 0) continue;
            const auto t = static_cast<std::size_t>(target_[slice * lanes + lane]);
            for (std::size_t k = 0; k < static_cast<std::size_t>(s.length(t)); ++k) {
                const std::size_t from = static_cast<std::size_t>(s.start[t]) + k,
                                  to = first + lanes * k + lane;
                const auto row = static_cast<std::size_t>(
                    std::find(delays_.begin(), delays_.end(), s.delay[from]) - delays_.begin());
                pre_[to] = static_cast<Cell>(row * source_cells_ + static_cast<std::size_t>(s.pre[from]));
                if (!same) weight_[to] = s.factor[from];
            }
        }
        first += length * lanes;
    }
}

template <class Cell>
void SlicedKernel<Cell>::deliver(const History& source, double* target) {
    prepare(source, 0, 1);
    add(source, target, 0, 1);
}

template <class Cell>
void SlicedKernel<Cell>::prepare(const History& source, int part, int parts) {
    const double gain = synapse_.gain();
    const Range cells(source_cells_, part, parts);
    for (std::size_t d = 0; d < delays_.size(); ++d) {
        const double* from = source.ago(delays_[d]) + cells.first;
        double* to = scaled_.data() + d * source_cells_ + cells.first;
        if (weight_.empty())
            scale(from, gain, factor_, cells.last - cells.first, to);
        else
            scale(from, gain, cells.last - cells.first, to);
    }
}

template <class Cell>
void SlicedKernel<Cell>::add(const History&, double* target, int part, int parts) {
    const Range range(slices_.size(), part, parts);
    for (std::size_t s = range.first; s < range.last;) {
        const std::size_t count = range.last - s >= together ? together : 1;
        Place<Cell> places[together];
        std::size_t lengths[together];
        double sums[together * lanes];
        for (std::size_t j = 0; j < count; ++j) {
            const auto [first, length] = slices_[s + j];
            places[j] = {&pre_[first], weight_.empty() ? nullptr : &weight_[first]};
            lengths[j] = length;
        }
        sum(places, lengths, count, scaled_.data(), sums);
        for (std::size_t i = 0; i < count * lanes; ++i)
            if (const int t = target_[s * lanes + i]; t >= 0) target[t] += sums[i];
        s += count;
    }
}

std::unique_ptr<Kernel> make_sliced(ByTarget& s, int source_cells, const SynapseInstance& synapse) {
    auto delays = delays_of(s);
    const std::size_t synapses = s.pre.size();
    const std::size_t places = delays.size() * static_cast<std::size_t>(source_cells) + 1;
    if (s.targets() < lanes || delays.size() > 16 || places > 2 * synapses + 1000 ||
        padded(s) > synapses + synapses / 4)
        return nullptr;
    if (places <= std::numeric_limits<std::uint16_t>::max())
        return std::make_unique<SlicedKernel<std::uint16_t>>(std::move(s), std::move(delays), source_cells,
                                                             synapse);
    return std::make_unique<SlicedKernel<std::uint32_t>>(std::move(s), std::move(delays), source_cells,
                                                         synapse);
}

}  // namespace forage::engine
