#include "modules/contextual_layer/prototype_store.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/types/simd.h"

namespace forage::contextual {
namespace {

constexpr Index lanes = 16, bits = 64;

using CellsOf = Eigen::Map<Eigen::ArrayXd, 0, Eigen::InnerStride<lanes>>;  ///< of one prototype in its block

/// Prototypes side by side, the cells of them that count, in order, and their sums of single-precision
/// numbers.
struct Block {
    const double* cells;  ///< [cell][lane]
    const Index* counted;
    Index count;
    double sums[lanes];
};

/// sums[l] += |cells[i][l] - present[i]| share for the cells i that count from the `from`-th to before the
/// `to`-th of each block, rounded to single precision each time. Such a sum takes its time: while that of one
/// block is rounded, others are computed. (Cells are listed, not looked for here: when there is more than
/// this in the loop GCC 12 takes the lanes apart and leaves some unrounded.)
template <std::size_t blocks>
[[gnu::always_inline]] inline void add_cells(Block* block, Index from, Index to, const double* present,
                                             double share) {
    double total[blocks * lanes];
    for (std::size_t b = 0; b < blocks; ++b) std::copy_n(block[b].sums, lanes, total + b * lanes);
    for (Index k = from; k < to; ++k)
#pragma GCC unroll 2
        for (std::size_t b = 0; b < blocks; ++b) {
            const Index cell = block[b].counted[k];
            const double* stored = block[b].cells + cell * lanes;
            const double here = present[cell];
            for (Index l = 0; l < lanes; ++l)
                total[b * lanes + l] =
                    static_cast<float>(total[b * lanes + l] + std::abs(stored[l] - here) * share);
        }
    for (std::size_t b = 0; b < blocks; ++b) std::copy_n(total + b * lanes, lanes, block[b].sums);
}

FORAGE_SIMD void add_one(Block& block, Index from, const double* present, double share) {
    add_cells<1>(&block, from, block.count, present, share);
}

FORAGE_SIMD void add_two(Block* blocks, Index count, const double* present, double share) {
    add_cells<2>(blocks, 0, count, present, share);
}

/// What a block's sums say, and 1 for prototypes without any activity.
FORAGE_SIMD void tell_distances(const double* sums, const std::uint8_t* silent, float* distances) {
    for (Index l = 0; l < lanes; ++l) {
        const auto distance = static_cast<float>(sums[l]);
        distances[l] = silent[l] ? 1.0F : distance;
    }
}

}  // namespace

/// Lists the cells of which a bit is set in a or b.
void PrototypeStore::CellList::list(const std::uint64_t* a, const std::uint64_t* b, Index words) {
    bool same = true;
    for (Index w = 0; w < words; ++w)
        same &= std::exchange(of[static_cast<std::size_t>(w)], a[w] | b[w]) == (a[w] | b[w]);
    if (same) return;
    count = 0;
    for (Index w = 0; w < words; ++w)
        for (std::uint64_t left = a[w] | b[w]; left; left &= left - 1)
            cells[static_cast<std::size_t>(count++)] = w * bits + std::countr_zero(left);
}

PrototypeStore::PrototypeStore(Index keys, Index capacity, Index cells)
    : cells_(cells),
      words_((cells + bits - 1) / bits),
      compared_(Eigen::ArrayXd::Zero(cells)),
      present_(Eigen::ArrayXd::Zero(cells)),
      active_(static_cast<std::size_t>(words_)) {
    for (CellList& list : counted_) {
        list.cells.resize(static_cast<std::size_t>(cells));
        list.of.resize(static_cast<std::size_t>(words_), 0);
    }
    const Index blocks = (capacity + lanes - 1) / lanes;
    blocks_.setZero(blocks * cells * lanes);
    used_.resize(static_cast<std::size_t>(blocks * words_), 0);
    silent_.resize(static_cast<std::size_t>(blocks * lanes), 0);
    keys_.reserve(static_cast<std::size_t>(capacity));
    slots_.resize(static_cast<std::size_t>(keys), 0);
}

void PrototypeStore::add(Index key, const Eigen::Ref<const Eigen::ArrayXf>& prototype) {
    current_ = false;
    const Index slot = size();
    const float peak = std::max(0.0F, prototype.maxCoeff());
    keys_.push_back(key);
    slots_[static_cast<std::size_t>(key)] = slot;
    silent_[static_cast<std::size_t>(slot)] = !(peak > 0);
    CellsOf cells(cells_of(slot), cells_);
    if (peak > 0)
        cells = (prototype / peak).cast<double>();
    else
        cells.setZero();
    note_use(slot / lanes);
}

void PrototypeStore::remove(Index key) {
    current_ = false;
    const Index slot = slots_[static_cast<std::size_t>(key)], last = size() - 1;
    if (slot != last) {  // the last one moves into the gap
        CellsOf(cells_of(slot), cells_) = CellsOf(cells_of(last), cells_);
        silent_[static_cast<std::size_t>(slot)] = silent_[static_cast<std::size_t>(last)];
        keys_[static_cast<std::size_t>(slot)] = keys_.back();
        slots_[static_cast<std::size_t>(keys_.back())] = slot;
        note_use(slot / lanes);
    }
    CellsOf(cells_of(last), cells_).setZero();
    note_use(last / lanes);
    keys_.pop_back();
}

void PrototypeStore::note_use(Index block) {
    std::uint64_t* used = &used_[static_cast<std::size_t>(block * words_)];
    std::fill_n(used, words_, 0);
    for (Index i = 0; i < cells_; ++i)
        if ((blocks_.segment<lanes>((block * cells_ + i) * lanes) != 0.0).any())
            used[i / bits] |= std::uint64_t{1} << (i % bits);
}

void PrototypeStore::compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    if (current_ && (present == compared_).all()) return;
    current_ = true;
    compared_ = present;
    const double peak = static_cast<float>(std::max(0.0, present.maxCoeff()));
    if (!(peak > 0)) {
        for (const Index key : keys_) distances[key] = 1;
        return;
    }
    present_ = present / peak;
    std::fill(active_.begin(), active_.end(), 0);
    for (Index i = 0; i < cells_; ++i)
        if (present_[i] != 0) active_[static_cast<std::size_t>(i / bits)] |= std::uint64_t{1} << (i % bits);
    const Index blocks = (size() + lanes - 1) / lanes;
    for (Index first = 0; first < blocks; first += 2)
        compare_blocks(first, std::min<Index>(2, blocks - first), distances);
}

void PrototypeStore::compare_blocks(Index first, Index count, float* distances) {
    const double share = 1.0F / static_cast<float>(cells_);
    Block pair[2];  // not cleared: that would take longer than it should
    for (Index b = 0; b < count; ++b) {
        CellList& counted =
            counted_[static_cast<std::size_t>(b)];  // cells that are 0 on both sides add nothing
        counted.list(&used_[static_cast<std::size_t>((first + b) * words_)], active_.data(), words_);
        pair[b].cells = blocks_.data() + (first + b) * cells_ * lanes;
        pair[b].counted = counted.cells.data(), pair[b].count = counted.count;
        std::fill_n(pair[b].sums, lanes, 0.0);
    }
    const Index together = count == 2 ? std::min(pair[0].count, pair[1].count) : 0;
    if (together > 0) add_two(pair, together, present_.data(), share);
    for (Index b = 0; b < count; ++b) {
        if (pair[b].count > together) add_one(pair[b], together, present_.data(), share);
        const Index begin = (first + b) * lanes, left = std::min(lanes, size() - begin);
        float found[lanes];
        tell_distances(pair[b].sums, &silent_[static_cast<std::size_t>(begin)], found);
        const Index* const keys = &keys_[static_cast<std::size_t>(begin)];
        for (Index l = 0; l < left; ++l) distances[keys[l]] = found[l];
    }
}

}  // namespace forage::contextual
