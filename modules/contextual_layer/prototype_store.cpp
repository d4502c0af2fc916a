#include "modules/contextual_layer/prototype_store.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/types/simd.h"

namespace forage::contextual {
namespace {

constexpr Index lanes = 16, bits = 64;

using CellsOf = Eigen::Map<Eigen::ArrayXd, 0, Eigen::InnerStride<lanes>>;  ///< of one prototype in its block

/// sums[b][l] = the sum of |cells[b][i][l] - present[i]| share over the `count` listed cells i, for two
/// blocks `stride` numbers apart, rounded to single precision each time. That takes its time: while the sum
/// of one block is rounded, the other's is computed. (Cells are listed, not looked for here, and a lone block
/// is taken twice: otherwise GCC 12 takes the lanes apart and leaves some unrounded.)
FORAGE_SIMD void add_two(const double* cells, Index stride, const Index* listed, Index count,
                         const double* present, double share, double* sums) {
    double total[2 * lanes];
    std::fill_n(total, 2 * lanes, 0.0);
    for (Index k = 0; k < count; ++k)
#pragma GCC unroll 2
        for (Index b = 0; b < 2; ++b) {
            const Index cell = listed[k];
            const double* stored = cells + b * stride + cell * lanes;
            const double here = present[cell];
            for (Index l = 0; l < lanes; ++l)
                total[b * lanes + l] =
                    static_cast<float>(total[b * lanes + l] + std::abs(stored[l] - here) * share);
        }
    std::copy_n(total, 2 * lanes, sums);
}

/// What a block's sums say, and 1 for prototypes without any activity.
FORAGE_SIMD void tell_distances(const double* sums, const std::uint8_t* silent, float* distances) {
    for (Index l = 0; l < lanes; ++l) {
        const auto distance = static_cast<float>(sums[l]);
        distances[l] = silent[l] ? 1.0F : distance;
    }
}

}  // namespace

/// Lists the cells of which a bit is set in one of the words. As what is 0 on both sides adds nothing, cells
/// that were listed before may stay, until they have cost about as much as a new list. (A number that is not
/// finite is not 0.)
void PrototypeStore::CellList::list(const std::uint64_t* first, const std::uint64_t* second,
                                    const std::uint64_t* present, Index words) {
    Index needed = 0;
    std::uint64_t missing = 0;
    for (Index w = 0; w < words; ++w) {
        const std::uint64_t needs = first[w] | second[w] | present[w];
        needed += std::popcount(needs);
        missing |= needs & ~of[static_cast<std::size_t>(w)];
    }
    if (!missing && (in_vain += count - needed) <= needed) return;
    count = in_vain = 0;
    for (Index w = 0; w < words; ++w) {
        std::uint64_t left = of[static_cast<std::size_t>(w)] = first[w] | second[w] | present[w];
        for (; left; left &= left - 1)
            cells[static_cast<std::size_t>(count++)] = w * bits + std::countr_zero(left);
    }
}

PrototypeStore::PrototypeStore(Index keys, Index capacity, Index cells)
    : cells_(cells),
      words_((cells + bits - 1) / bits),
      compared_(Eigen::ArrayXd::Zero(cells)),
      present_(Eigen::ArrayXd::Zero(cells)),
      active_(static_cast<std::size_t>(words_)) {
    counted_.cells.resize(static_cast<std::size_t>(cells));
    counted_.of.resize(static_cast<std::size_t>(words_), 0);
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
    const std::uint64_t *used = &used_[static_cast<std::size_t>(first * words_)],
                        *second_used = used + (count - 1) * words_;
    counted_.list(used, second_used, active_.data(), words_);
    const double* const cells = blocks_.data() + first * cells_ * lanes;
    double sums[2 * lanes];
    add_two(cells, (count - 1) * cells_ * lanes, counted_.cells.data(), counted_.count, present_.data(),
            share, sums);
    for (Index b = 0; b < count; ++b) {
        const Index begin = (first + b) * lanes, left = std::min(lanes, size() - begin);
        float found[lanes];
        tell_distances(sums + b * lanes, &silent_[static_cast<std::size_t>(begin)], found);
        const Index* const keys = &keys_[static_cast<std::size_t>(begin)];
        for (Index l = 0; l < left; ++l) distances[keys[l]] = found[l];
    }
}

}  // namespace forage::contextual
