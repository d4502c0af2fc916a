// Weights laid out by their source, for connections to nearly all cells and for windows whose weights differ:
// no cell numbers, and the weights of silent sources are not read. 900 x 900 weights with 30 % of the sources
// active take 38 us, a list takes 265.
//
// To leave out a product that is 0 changes no bit: a sum that begins with 0 is never -0, and the weights are
// finite.
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/huge_pages.h"
#include "core/base/simd.h"
#include "core/engine/kernels/source_layout.h"

namespace forage::engine {
namespace {

typedef double Lanes __attribute__((vector_size(SourceLayout::lanes * sizeof(double))));  // NOLINT

constexpr int max_together = 4;
constexpr double max_places = 1.5;  // per synapse
/// Sources whose weights are added together, one after the other, so that sums are read and written once.
struct Together {
    const double* weights[max_together];
    const double* next[max_together];  ///< what is read afterwards: fetched, as no pattern tells its place
    double activity[max_together];
};

/// Where the weight is NaN there is no synapse.
template <int sources>
[[gnu::always_inline]] inline void add_sources(const Together& from, Index n, double* sums) {
    const Together own = from;  // what is stored into the sums cannot change it
#pragma GCC unroll 4
    for (Index i = 0; i < n; i += SourceLayout::lanes) {
        Lanes sum;
        std::memcpy(&sum, sums + i, sizeof sum);
#pragma GCC unroll 8
        for (int k = 0; k < sources; ++k) {
            Lanes weight;
            std::memcpy(&weight, own.weights[k] + i, sizeof weight);
            __builtin_prefetch(own.next[k] + i, 0, 2);
            // NOLINTNEXTLINE(misc-redundant-expression): only a NaN differs from itself
            sum += weight == weight ? weight * own.activity[k] : Lanes{};
        }
        std::memcpy(sums + i, &sum, sizeof sum);
    }
}
FORAGE_SIMD void add_one_source(const Together& from, Index n, double* sums) {
    add_sources<1>(from, n, sums);
}
FORAGE_SIMD void add_four_sources(const Together& from, Index n, double* sums) {
    add_sources<max_together>(from, n, sums);
}

FORAGE_SIMD void scale(const double* from, Index stride, double gain, Index n, double* to) {
    for (Index i = 0; i < n; ++i) to[i] = from[i * stride] * gain;
}

class BySource final : public SharedKernel {
  public:
    BySource(SourceLayout layout, const ByTarget& s) : layout_(std::move(layout)), delay_(s.delay[0]) {
        weights_.assign(layout_.places, std::numeric_limits<double>::quiet_NaN());
        for (int t = 0; t < std::ssize(s.start) - 1; ++t)
            for (int i = s.start[t]; i < s.start[t + 1]; ++i)
                weights_[layout_.place(s.pre[i], t)] = s.factor[i];
    }
    /// Of a matrix, targets x sources.
    BySource(SourceLayout layout, const Array& matrix, int delay)
        : layout_(std::move(layout)), delay_(delay) {
        weights_.resize(layout_.places);
        constexpr std::size_t rows = 64, tile = 8;  // a tile is one line of the cache in each row
        const std::size_t targets = layout_.target.cells, sources = layout_.sources.size();
        std::vector<double> some(rows * sources);
        for (std::size_t first = 0; first < targets; first += rows) {
            const std::size_t count = std::min(rows, targets - first);
            matrix.copy(first, count, some.data());
            for (std::size_t s = 0; s < sources; s += tile) {
                const std::size_t width = std::min(tile, sources - s);
                double turned[tile][rows];
                for (std::size_t t = 0; t < count; ++t)
                    for (std::size_t i = 0; i < width; ++i) turned[i][t] = some[t * sources + s + i];
                for (std::size_t i = 0; i < width; ++i)
                    std::copy_n(turned[i], count, &weights_[layout_.sources[s + i].place + first]);
            }
        }
    }
    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Work>();
        out->scaled.resize(layout_.sources.size());
        out->sums.resize(layout_.slots());
        return out;
    }
    void prepare(const KernelInput& in, Part part) const override {
        const Lines& source = layout_.source;
        double* scaled = static_cast<Work*>(in.workspace)->scaled.data();
        for (auto line = part.first(source.lines); line < part.last(source.lines); ++line)
            scale(in.ago(delay_) + line * source.to_next_line, source.to_next_cell, in.synapse.gain(),
                  source.cells, scaled + line * source.cells);
    }
    void add(const Workspace& workspace, double* target, Part part) const override {
        // The frame is divided by target cells, so that the sums of each stretch stay in the nearest cache.
        constexpr Index lanes = SourceLayout::lanes, max_slots = 2048;
        const Index grains = (layout_.target.cells + lanes - 1) / lanes,
                    step = std::max<Index>(1, max_slots / (lanes * layout_.ring)),
                    last = static_cast<Index>(part.last(grains));
        for (Index grain = static_cast<Index>(part.first(grains)); grain < last; grain += step)
            add_cells(static_cast<const Work&>(workspace), grain * lanes,
                      std::min<Index>(std::min(grain + step, last) * lanes, layout_.target.cells), target);
    }
    Index target_cells() const override { return Index{layout_.target.cells} * layout_.target.lines; }
    std::string_view form() const override { return "by source"; }
    double cost() const override { return 0.1 * static_cast<double>(layout_.places); }

  private:
    struct Work final : Workspace {
        HugeVector<double> scaled;        ///< gain times activity of the sources, line by line
        mutable HugeVector<double> sums;  ///< the frame, 0 between deliveries; each part has its own stretch
    };
    /// Of target cells.
    struct Cells {
        Index first, last;
        Index first_slot, last_slot;
    };

    void add_cells(const Work& w, Index first_cell, Index last_cell, double* target) const {
        const Lines& source = layout_.source;
        const Cells cells{first_cell, last_cell, first_cell * layout_.ring,
                          last_cell < layout_.target.cells ? last_cell * layout_.ring : layout_.slots()};
        int first = 0, last = 0;  // live lines
        for (int line = 0; line < source.lines; ++line) {
            leave(w, cells, first, std::min(layout_.left[line], last), target);
            first = layout_.left[line], last = layout_.entered[line];
            const double* scaled = &w.scaled[static_cast<std::size_t>(line) * source.cells];
            constexpr int block = 256;
            for (int begin = 0; begin < source.cells; begin += block) {
                int active[block], count = 0;
                for (int cell = begin; cell < std::min(begin + block, source.cells); ++cell) {
                    active[count] = cell;  // without branches: spikes cannot be foreseen
                    count += scaled[cell] != 0;
                }
                add_active(w, cells, line, active, count);
            }
        }
        leave(w, cells, first, last, target);
    }

    /// Adds what active sources of a line deliver.
    void add_active(const Work& w, const Cells& cells, int line, const int* active, int count) const {
        const auto first_of_line = static_cast<std::size_t>(line) * layout_.source.cells;
        const auto* sources = &layout_.sources[first_of_line];
        const auto weights_of = [&](int k) {
            const auto& from = sources[active[std::min(k, count - 1)]];
            return weights_.data() + from.place +
                   std::clamp<Index>(cells.first_slot - from.slot, 0, from.size);
        };
        const auto take = [&](Together& together, int i, int k, int ahead) {
            together.weights[i] = weights_of(k), together.next[i] = weights_of(k + ahead);
            together.activity[i] = w.scaled[first_of_line + active[k]];
        };
        Together together;
        int k = 0;
        if (layout_.dense)
            for (; k + max_together <= count; k += max_together) {
                for (int i = 0; i < max_together; ++i) take(together, i, k + i, max_together);
                add_four_sources(together, cells.last_slot - cells.first_slot, &w.sums[cells.first_slot]);
            }
        for (; k < count; ++k) {
            const auto& from = sources[active[k]];
            const Index first = std::max(from.slot, cells.first_slot),
                        last = std::min(from.slot + from.size, cells.last_slot);
            if (first >= last) continue;
            take(together, 0, k, 2);
            add_one_source(together, last - first, &w.sums[first]);
        }
    }

    /// Lines leave the frame.
    void leave(const Work& w, const Cells& cells, int first, int last, double* target) const {
        for (int line = first; line < last; ++line)
            for (Index cell = cells.first; cell < cells.last; ++cell) {
                double& sum = w.sums[layout_.slot(static_cast<int>(cell), line)];
                target[layout_.target.index(static_cast<int>(cell), line)] += sum;
                sum = 0;
            }
    }

    SourceLayout layout_;
    int delay_;
    HugeVector<double> weights_;  ///< by place
};

}  // namespace

bool fits_matrix(const Array& weights, GroupShape target) {
    constexpr int min_targets = 8;
    const auto places = static_cast<double>(weights.rows()) * static_cast<double>(weights.columns());
    return target.cells >= min_targets &&
           places <= max_places * (places - static_cast<double>(weights.left_out()));
}

std::unique_ptr<Kernel> make_kernel(const Array& weights, GroupShape source, GroupShape target, int delay) {
    return std::make_unique<BySource>(lay_out_all(source, target), weights, delay);
}

std::unique_ptr<Kernel> make_by_source(const ByTarget& s, GroupShape source, GroupShape target) {
    constexpr std::size_t least_dense = 8, least_local = 32;  // synapses per source; each source has its cost
    const auto sources = static_cast<std::size_t>(source.cells);
    const auto alike = [](const auto& all) {
        return std::all_of(all.begin(), all.end(), [&](auto v) { return v == all.front(); });
    };
    if (s.pre.size() < least_dense * sources || !alike(s.delay) || alike(s.factor) ||
        !std::all_of(s.factor.begin(), s.factor.end(), [](double f) { return std::isfinite(f); }))
        return nullptr;
    auto layout = lay_out_by_source(s, source, target, max_places);
    if (!layout || (!layout->dense && s.pre.size() < least_local * sources)) return nullptr;
    return std::make_unique<BySource>(std::move(*layout), s);
}

}  // namespace forage::engine
