#include "core/engine/kernels/sliced_kernel.h"

#include <algorithm>
#include <limits>

#include "core/base/simd.h"
#include "core/engine/kernels/slice_sums.h"

namespace forage::engine {
namespace {

constexpr std::size_t lanes = Slices::lanes, half = Slices::half;

/// Of a block of sources, for all delays: 20 KB, which leave room for what passes by, in the 32 KB of the
/// nearest cache of today's processors.
constexpr std::size_t block_places = 2560;

constexpr std::size_t most_delays = 16;

std::vector<int> delays_of(const ByTarget& s) {
    std::vector<int> out;
    for (const int d : s.delay)
        if (std::find(out.begin(), out.end(), d) == out.end()) {
            out.push_back(d);
            if (out.size() > most_delays) break;
        }
    return out;
}

FORAGE_SIMD void scale(const double* from, double gain, double factor, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] * gain * factor;
}

FORAGE_SIMD void scale(const double* from, double gain, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] * gain;
}

}  // namespace

template <class Cell>
SlicedKernel<Cell>::SlicedKernel(ByTarget s, Slices slices, std::vector<int> delays, std::size_t source_cells,
                                 const SynapseInstance& synapse)
    : synapse_(synapse),
      slices_(std::move(slices)),
      delays_(std::move(delays)),
      source_cells_(source_cells),
      targets_(s.targets()),
      stride_((delays_.size() * slices_.block_cells / lanes + 1) * lanes),  // with room for the 0
      scaled_((source_cells_ + slices_.block_cells - 1) / slices_.block_cells * stride_),
      factor_(s.factor[0]) {
    if (std::all_of(s.factor.begin(), s.factor.end(), [&](double f) { return f == factor_; }))
        s.factor = std::vector<double>();
    if (delays_.size() == 1) s.delay = std::vector<int>();
    fill(s);
}

template <class Cell>
void SlicedKernel<Cell>::fill(const ByTarget& s) {
    pre_.assign(slices_.entries(), static_cast<Cell>(delays_.size() * slices_.block_cells));
    if (!s.factor.empty())
        for (auto& weights : weights_) weights.assign(pre_.size() / 2, 0.0);
    std::vector<int> next(s.start.begin(), s.start.end() - 1);  // synapse of each target
    std::size_t entry = 0, place = 0;
    for (std::size_t panel = 0; panel + 1 < slices_.panels.size(); ++panel)
        for (std::size_t r = slices_.panels[panel].run; r < slices_.panels[panel + 1].run; ++r) {
            const auto [block, slices, length] = slices_.runs[r];
            const std::size_t first = block * slices_.block_cells, last = first + slices_.block_cells;
            for (std::size_t i = 0; i < slices; ++i, entry += lanes * length)
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    const std::size_t in_panel = slices_.targets[place++];
                    if (in_panel == slices_.panel_cells) continue;
                    const std::size_t t = panel * slices_.panel_cells + in_panel;
                    for (std::size_t to = entry + lane; next[t] < s.start[t + 1]; to += lanes, ++next[t]) {
                        const auto from = static_cast<std::size_t>(next[t]);
                        const auto pre = static_cast<std::size_t>(s.pre[from]);
                        if (pre >= last) break;
                        const auto row =
                            s.delay.empty()
                                ? 0
                                : std::find(delays_.begin(), delays_.end(), s.delay[from]) - delays_.begin();
                        pre_[to] = static_cast<Cell>(static_cast<std::size_t>(row) * slices_.block_cells +
                                                     (pre - first));
                        if (!s.factor.empty())
                            weights_[lane / half][to / lanes * half + lane % half] = s.factor[from];
                    }
                }
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
    for (std::size_t cell = cells.first; cell < cells.last;) {
        const std::size_t block = cell / slices_.block_cells, in_block = cell % slices_.block_cells;
        const std::size_t n = std::min(slices_.block_cells - in_block, cells.last - cell);
        double* to = scaled_.data() + block * stride_ + in_block;
        for (std::size_t d = 0; d < delays_.size(); ++d, to += slices_.block_cells) {
            const double* from = source.ago(delays_[d]) + cell;
            if (same_factor())
                scale(from, gain, factor_, n, to);
            else
                scale(from, gain, n, to);
        }
        cell += n;
    }
}

template <class Cell>
void SlicedKernel<Cell>::add(const History&, double* target, int part, int parts) {
    double sums[Slices::most_panel_cells + 1];
    const Range range(slices_.panels.size() - 1, part, parts);
    for (std::size_t p = range.first; p < range.last; ++p) {
        const auto &panel = slices_.panels[p], &next = slices_.panels[p + 1];
        const std::size_t first = p * slices_.panel_cells,
                          n = std::min(slices_.panel_cells, targets_ - first);
        const auto weights = [&](std::size_t which) {
            return same_factor() ? nullptr : weights_[which].data() + panel.entry / 2;
        };
        std::fill_n(sums, slices_.panel_cells + 1, 0.0);
        add_stream({slices_.runs.data() + panel.run,
                    slices_.runs.data() + next.run,
                    slices_.targets.data() + panel.slice * lanes,
                    pre_.data() + panel.entry,
                    {weights(0), weights(1)},
                    scaled_.data(),
                    stride_},
                   sums);
        add_sums(sums, n, target + first);
    }
}

std::unique_ptr<Kernel> make_sliced(ByTarget& s, int source_cells, const SynapseInstance& synapse) {
    auto delays = delays_of(s);
    const auto cells = static_cast<std::size_t>(source_cells);
    const std::size_t synapses = s.pre.size(), places = delays.size() * cells;
    if (s.targets() < lanes || delays.size() > most_delays || places > 2 * synapses + 1000) return nullptr;
    const auto arranged = [&](std::size_t block_cells) {
        auto slices = arrange(s, cells, block_cells);
        if (slices && slices->entries() > synapses + synapses / 4) slices.reset();
        return slices;
    };
    std::optional<Slices> slices;
    if (places > block_places) slices = arranged(block_places / delays.size());
    if (!slices) slices = arranged(cells);
    if (!slices) return nullptr;
    if (delays.size() * slices->block_cells <= std::numeric_limits<std::uint16_t>::max())
        return std::make_unique<SlicedKernel<std::uint16_t>>(std::move(s), std::move(*slices),
                                                             std::move(delays), cells, synapse);
    return std::make_unique<SlicedKernel<std::uint32_t>>(std::move(s), std::move(*slices), std::move(delays),
                                                         cells, synapse);
}

}  // namespace forage::engine
