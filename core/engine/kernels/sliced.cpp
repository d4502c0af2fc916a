// Lists of synapses, eight targets side by side: each is summed in synapse order, and no sum waits for its
// own last addition. For the colour planes of the DAC system, 9,408 synapses in 3 us, where a list takes 10,
// and for random connections: 0.45 to 0.62 ns per synapse, a third of a list.
//
// Targets are divided into panels and sources into blocks: the activity of a block stays in the nearest
// cache, the sums of a panel in the second. The synapses from a block to a panel are a tile; panels follow
// each other, and in each its tiles. Within a tile targets stand in slices of eight, those with most synapses
// first ("sliced ELLPACK"; Kreutzer et al., "A unified sparse matrix data format...", SIAM J. Sci. Comput.
// 36, 2014): synapse k of lane l of a slice is its entry 8 k + l. Lanes that have no such synapse read a cell
// that is always 0.
#include <cstring>
#include <limits>

#include "core/base/huge_pages.h"
#include "core/base/simd.h"
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

constexpr std::size_t slice_lanes = 8, half_slice = slice_lanes / 2, max_panel_cells = 8192;
/// Activities of a block, for all delays: 20 KB, which leave room in the nearest cache for what passes by.
constexpr std::size_t block_places = 2560;
constexpr std::size_t max_delays = 16;

/// Slices of a tile that follow each other and are of the same length.
struct SliceRun {
    std::uint32_t block, slices, length;
};
/// The first of what belongs to a panel.
struct Panel {
    std::size_t run, slice, entry;
};

/// Loading single numbers takes the time, so that wider vectors gain nothing.
typedef double Half __attribute__((vector_size(half_slice * sizeof(double))));  // NOLINT: no `using` for this
typedef double Pair __attribute__((vector_size(half_slice / 2 * sizeof(double))));  // NOLINT

[[gnu::always_inline]] inline void gather(const double* from, const std::uint16_t* places, Half& to) {
    // In pairs: GCC 12 puts four single numbers one by one into a register, and waits for what was in it.
    const Pair low{from[places[0]], from[places[1]]}, high{from[places[2]], from[places[3]]};
#if __has_builtin(__builtin_shufflevector)
    to = __builtin_shufflevector(low, high, 0, 1, 2, 3);
#else
    to = Half{low[0], low[1], high[0], high[1]};
#endif
}

[[gnu::always_inline]] inline void scatter(const Half& from, const std::uint16_t* places, double* to) {
    for (std::size_t l = 0; l < half_slice; ++l) to[places[l]] = from[l];
}

/// How far ahead of what is summed entries are fetched, into the second cache.
constexpr std::size_t ahead = 320;
[[gnu::always_inline]] inline void fetch(const void* address) { __builtin_prefetch(address, 0, 2); }

/// What is read of a panel.
struct PanelStream {
    const SliceRun *run, *end;
    const std::uint16_t *targets, *pre;
    const double* weights;  ///< null when all are alike
    const double* scaled;   ///< of block 0
    std::size_t stride;     ///< from one block to the next
};

/// sums[t] += what each synapse of target t of the panel delivers, in order. `sums` has one more number,
/// which lanes without a target add to.
template <bool weighted>
[[gnu::always_inline]] inline void add_panel(PanelStream s, double* sums) {
    for (; s.run < s.end; ++s.run) {
        const double* scaled = s.scaled + s.run->block * s.stride;
        for (std::size_t slice = 0; slice < s.run->slices; ++slice, s.targets += slice_lanes) {
            Half halves[2];
            gather(sums, s.targets, halves[0]), gather(sums, s.targets + half_slice, halves[1]);
            for (std::size_t row = 0; row < s.run->length; ++row) {
                fetch(s.pre + ahead);
                if constexpr (weighted) fetch(s.weights + ahead);
                for (std::size_t i = 0; i < 2; ++i) {
                    Half psp;
                    gather(scaled, s.pre + i * half_slice, psp);
                    if constexpr (weighted) {
                        Half weight;
                        std::memcpy(&weight, s.weights + i * half_slice, sizeof weight);
                        psp *= weight;
                    }
                    halves[i] += psp;
                }
                s.pre += slice_lanes;
                if constexpr (weighted) s.weights += slice_lanes;
            }
            scatter(halves[0], s.targets, sums), scatter(halves[1], s.targets + half_slice, sums);
        }
    }
}

FORAGE_SIMD void add_weighted_panel(const PanelStream& s, double* sums) { add_panel<true>(s, sums); }
FORAGE_SIMD void add_alike_panel(const PanelStream& s, double* sums) { add_panel<false>(s, sums); }

FORAGE_SIMD void add_sums(const double* sums, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] += sums[i];
}

FORAGE_SIMD void scale_block(const double* from, double gain, double factor, std::size_t n, double* to) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] * gain * factor;
}

std::size_t divided_up(std::size_t n, std::size_t by) { return (n + by - 1) / by; }

/// Large panels share the activity of a block among many synapses; eight of about the same size, or a
/// multiple, can be shared among threads.
std::size_t cells_of_panel(std::size_t targets) {
    constexpr std::size_t least = 256, together = 8;
    const std::size_t panels =
        together * std::max<std::size_t>(1, divided_up(targets, together * max_panel_cells));
    return std::max(least, divided_up(divided_up(targets, panels), slice_lanes) * slice_lanes);
}

class Sliced final : public SharedKernel {
  public:
    Sliced(std::vector<int> delays, std::size_t source_cells, std::size_t target_cells,
           std::size_t block_cells)
        : delays_(std::move(delays)),
          source_cells_(source_cells),
          target_cells_(target_cells),
          block_cells_(block_cells),
          panel_cells_(cells_of_panel(target_cells)),
          stride_((delays_.size() * block_cells / slice_lanes + 1) * slice_lanes) {}  // with room for the 0

    /// Reads the synapses. False when a target returns to a block after another one, as its synapses would
    /// be summed in another order, or when targets have so different numbers of synapses that a list serves
    /// better.
    bool fill(const ByTarget& s) {
        const bool alike =
            std::all_of(s.factor.begin(), s.factor.end(), [&](double f) { return f == s.factor[0]; });
        if (alike) factor_ = s.factor[0];
        const std::size_t most = s.pre.size() + s.pre.size() / 4;
        pre_.reserve(most);
        if (!alike) weights_.reserve(most);
        std::vector<std::vector<Lane>> tiles(divided_up(source_cells_, block_cells_));
        for (std::size_t first = 0; first < target_cells_; first += panel_cells_) {
            panels_.push_back({runs_.size(), targets_.size() / slice_lanes, pre_.size()});
            for (std::size_t t = first; t < std::min(first + panel_cells_, target_cells_); ++t)
                for (int i = s.start[t], least = 0; i < s.start[t + 1];) {
                    const auto block = static_cast<int>(s.pre[i] / block_cells_), from = i;
                    if (block < least) return false;
                    while (i < s.start[t + 1] && static_cast<int>(s.pre[i] / block_cells_) == block) ++i;
                    tiles[block].push_back({from, i - from, static_cast<std::uint16_t>(t - first)});
                    least = block + 1;
                }
            for (std::size_t block = 0; block < tiles.size(); ++block)
                if (!add_tile(s, alike, block, tiles[block], most)) return false;
        }
        panels_.push_back({runs_.size(), targets_.size() / slice_lanes, pre_.size()});
        return true;
    }

    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Scaled>();
        out->cells.resize(divided_up(source_cells_, block_cells_) * stride_);
        return out;
    }
    void prepare(const KernelInput& in, Part part) const override {
        const double gain = in.synapse.gain();
        for (std::size_t cell = part.first(source_cells_); cell < part.last(source_cells_);) {
            const std::size_t block = cell / block_cells_, in_block = cell % block_cells_,
                              n = std::min(block_cells_ - in_block, part.last(source_cells_) - cell);
            double* to = static_cast<Scaled*>(in.workspace)->cells.data() + block * stride_ + in_block;
            for (std::size_t d = 0; d < delays_.size(); ++d, to += block_cells_)
                scale_block(in.ago(delays_[d]) + cell, gain, factor_, n, to);
            cell += n;
        }
    }

    void add(const Workspace& scaled, double* target, Part part) const override {
        double sums[max_panel_cells + 1];
        const std::size_t panels = panels_.size() - 1;
        for (std::size_t p = part.first(panels); p < part.last(panels); ++p) {
            const auto &panel = panels_[p], &next = panels_[p + 1];
            const PanelStream stream{runs_.data() + panel.run,
                                     runs_.data() + next.run,
                                     targets_.data() + panel.slice * slice_lanes,
                                     pre_.data() + panel.entry,
                                     weights_.empty() ? nullptr : weights_.data() + panel.entry,
                                     static_cast<const Scaled&>(scaled).cells.data(),
                                     stride_};
            std::fill_n(sums, panel_cells_ + 1, 0.0);
            (weights_.empty() ? add_alike_panel : add_weighted_panel)(stream, sums);
            const std::size_t first = p * panel_cells_;
            add_sums(sums, std::min(panel_cells_, target_cells_ - first), target + first);
        }
    }
    Index target_cells() const override { return static_cast<Index>(target_cells_); }
    std::string_view form() const override { return "sliced"; }
    double cost() const override {
        return (weights_.empty() ? 0.3 : 0.45) * static_cast<double>(pre_.size());
    }

  private:
    /// By block, every stride_ numbers: by delay, gain times activity of the block's cells; then a 0.
    struct Scaled final : Workspace {
        HugeVector<double> cells;
    };
    /// The synapses of a target in a tile.
    struct Lane {
        int first, length;
        std::uint16_t target;  ///< in its panel
    };

    bool add_tile(const ByTarget& s, bool alike, std::size_t block, std::vector<Lane>& lanes,
                  std::size_t most) {
        std::stable_sort(lanes.begin(), lanes.end(),
                         [](const Lane& a, const Lane& b) { return a.length > b.length; });
        const auto none = static_cast<std::uint16_t>(panel_cells_);
        lanes.resize(divided_up(lanes.size(), slice_lanes) * slice_lanes, Lane{0, 0, none});
        const std::size_t first_run = runs_.size();
        for (std::size_t i = 0; i < lanes.size(); i += slice_lanes) {
            const int length = lanes[i].length;
            if (pre_.size() + length * slice_lanes > most) return false;
            if (runs_.size() == first_run || runs_.back().length != static_cast<std::uint32_t>(length))
                runs_.push_back({static_cast<std::uint32_t>(block), 0, static_cast<std::uint32_t>(length)});
            ++runs_.back().slices;
            for (std::size_t l = i; l < i + slice_lanes; ++l) targets_.push_back(lanes[l].target);
            for (int k = 0; k < length; ++k)
                for (std::size_t l = i; l < i + slice_lanes; ++l) {
                    const bool there = k < lanes[l].length;
                    const int synapse = lanes[l].first + k;
                    pre_.push_back(there ? place(s, synapse, block)
                                         : static_cast<std::uint16_t>(delays_.size() * block_cells_));
                    if (!alike) weights_.push_back(there ? s.factor[synapse] : 0.0);
                }
        }
        lanes.clear();
        return true;
    }

    /// Where in the block's part of the workspace a synapse reads.
    std::uint16_t place(const ByTarget& s, int synapse, std::size_t block) const {
        const auto delay = std::find(delays_.begin(), delays_.end(), s.delay[synapse]) - delays_.begin();
        return static_cast<std::uint16_t>(delay * block_cells_ + s.pre[synapse] - block * block_cells_);
    }

    std::vector<int> delays_;  ///< those that occur
    std::size_t source_cells_, target_cells_, block_cells_, panel_cells_, stride_;
    double factor_ = 1;          ///< of every synapse, when it is the same
    std::vector<Panel> panels_;  ///< and one for the end
    std::vector<SliceRun> runs_;
    HugeVector<std::uint16_t> targets_;  ///< of lane l of slice i: targets_[8 i + l], in its panel
    HugeVector<std::uint16_t> pre_;      ///< of the entries: places in a block
    HugeVector<double> weights_;         ///< factors of the entries; empty when all are the same
};

}  // namespace

std::unique_ptr<Kernel> make_sliced(const ByTarget& s, int source_cells) {
    std::vector<int> delays;
    for (const int d : s.delay)
        if (std::find(delays.begin(), delays.end(), d) == delays.end()) {
            delays.push_back(d);
            if (delays.size() > max_delays) return nullptr;
        }
    const auto cells = static_cast<std::size_t>(source_cells);
    const std::size_t places = cells * delays.size(), block = block_places / delays.size();
    if (s.targets() < slice_lanes || places > 2 * s.pre.size() + 1000) return nullptr;
    const auto made = [&](std::size_t block_cells) {
        auto out = std::make_unique<Sliced>(delays, cells, s.targets(), block_cells);
        return out->fill(s) ? std::move(out) : nullptr;
    };
    if (block < cells)
        if (auto out = made(block)) return out;
    return places <= std::numeric_limits<std::uint16_t>::max() ? made(cells) : nullptr;
}

}  // namespace forage::engine
