#include "modules/contextual_layer/prototype_store.h"

#include <algorithm>
#include <cmath>

#include "core/base/simd.h"

namespace forage::contextual {
namespace {

constexpr int wait_after_vain = 16;

using CellsOf = Eigen::Map<Eigen::ArrayXd, 0, Eigen::InnerStride<lanes>>;  ///< of one prototype in its block

/// sums[b][l] = the sum of |cells_b[i][l] - present[i]| share over the `count` listed cells i, for two
/// blocks, rounded to single precision each time. That takes its time: while the sum of one block is rounded,
/// the other's is computed. (Cells are listed, not looked for here, and a lone block is taken twice:
/// otherwise GCC 12 takes the lanes apart and leaves some unrounded.)
FORAGE_SIMD void add_two(const double* first, const double* second, const Index* listed, Index count,
                         const double* present, double share, double* sums) {
    double total[2 * lanes];
    std::fill_n(total, 2 * lanes, 0.0);
    for (Index k = 0; k < count; ++k)
#pragma GCC unroll 2
        for (Index b = 0; b < 2; ++b) {
            const Index cell = listed[k];
            const double* stored = (b ? second : first) + cell * lanes;
            const double here = present[cell];
            for (Index l = 0; l < lanes; ++l)
                total[b * lanes + l] =
                    static_cast<float>(total[b * lanes + l] + std::abs(stored[l] - here) * share);
        }
    std::copy_n(total, 2 * lanes, sums);
}

}  // namespace

PrototypeStore::PrototypeStore(Index keys, Index capacity, Index cells)
    : cells_(cells),
      words_((cells + cells_per_word - 1) / cells_per_word),
      compared_(Eigen::ArrayXd::Zero(cells)),
      present_(Eigen::ArrayXd::Zero(cells)),
      active_(static_cast<std::size_t>(words_)),
      coarse_((capacity + lanes - 1) / lanes, cells),
      counted_(cells) {
    const Index blocks = (capacity + lanes - 1) / lanes;
    blocks_.setZero(blocks * cells * lanes);
    used_.resize(static_cast<std::size_t>(blocks * words_), 0);
    silent_.resize(static_cast<std::size_t>(blocks * lanes), 0);
    keys_.reserve(static_cast<std::size_t>(capacity));
    slots_.resize(static_cast<std::size_t>(keys), 0);
    exact_.resize(static_cast<std::size_t>(blocks), 1);
    odd_.resize(static_cast<std::size_t>(blocks * lanes), 0);
    needed_.reserve(static_cast<std::size_t>(blocks));
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
    note_cells(slot);
}

void PrototypeStore::remove(Index key) {
    current_ = false;
    const Index slot = slots_[static_cast<std::size_t>(key)], last = size() - 1;
    if (slot != last) {  // the last one moves into the gap
        CellsOf(cells_of(slot), cells_) = CellsOf(cells_of(last), cells_);
        silent_[static_cast<std::size_t>(slot)] = silent_[static_cast<std::size_t>(last)];
        keys_[static_cast<std::size_t>(slot)] = keys_.back();
        slots_[static_cast<std::size_t>(keys_.back())] = slot;
        note_cells(slot);
    }
    CellsOf(cells_of(last), cells_).setZero();
    note_cells(last);
    keys_.pop_back();
}

/// Notes what follows from the cells of a slot.
void PrototypeStore::note_cells(Index slot) {
    const CellsOf cells(cells_of(slot), cells_);
    auto& odd = odd_[static_cast<std::size_t>(slot)];
    odd_ones_ -= odd;
    odd = !(cells >= 0.0 && cells <= 1.0).all();
    odd_ones_ += odd;
    for (Index i = 0; i < cells_ && coarse_.useful(); ++i) coarse_.put(slot, i, odd ? 0 : cells[i]);

    const Index block = slot / lanes;
    std::uint64_t* used = &used_[static_cast<std::size_t>(block * words_)];
    std::fill_n(used, words_, 0);
    for (Index i = 0; i < cells_; ++i)
        if ((blocks_.segment<lanes>((block * cells_ + i) * lanes) != 0.0).any())
            used[i / cells_per_word] |= std::uint64_t{1} << (i % cells_per_word);
}

void PrototypeStore::restore() {
    const auto slots = static_cast<Index>(silent_.size());
    for (Index slot = 0; slot < slots; ++slot) note_cells(slot);
    estimated_ = std::count(exact_.begin(), exact_.begin() + blocks_in_use(), 0);
}

/// Takes p. False when nothing is to be compared: the distances in the array hold for it.
bool PrototypeStore::take(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    if (current_ && (present == compared_).all()) return false;
    current_ = true;
    compared_ = present;
    const double peak = static_cast<float>(std::max(0.0, present.maxCoeff()));
    const bool silent = !(peak > 0);
    std::fill_n(exact_.begin(), blocks_in_use(), silent);
    estimated_ = silent ? 0 : blocks_in_use();
    if (silent) {
        for (const Index key : keys_) distances[key] = 1;
        return false;
    }
    present_ = present / peak;
    std::fill(active_.begin(), active_.end(), 0);
    for (Index i = 0; i < cells_; ++i)
        if (present_[i] != 0)
            active_[static_cast<std::size_t>(i / cells_per_word)] |= std::uint64_t{1} << (i % cells_per_word);
    return true;
}

void PrototypeStore::compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    take(present, distances);
    need_all();
    compare_needed(distances);
}

void PrototypeStore::estimate(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    if (!take(present, distances)) return;
    if (in_vain_ > 0 || !can_estimate()) {
        in_vain_ = std::max(0, in_vain_ - 1);
        need_all();
        compare_needed(distances);
        return;
    }
    coarse_.compare_with(present_);
    const Index blocks = blocks_in_use();
    for (Index first = 0; first < blocks; first += 2) {
        const Index second = std::min(first + 1, blocks - 1);
        list_cells(first, second);
        float found[2 * lanes];
        coarse_.estimate(first, second, counted_, found);
        tell(first, found, distances);
        tell(second, found + lanes, distances);
    }
}

bool PrototypeStore::can_estimate() const {
    return coarse_.useful() && odd_ones_ == 0 &&
           (present_ >= 0.0 && present_ <= CoarsePrototypes::most).all();
}

void PrototypeStore::need(Index key) { need_block(slots_[static_cast<std::size_t>(key)] / lanes); }

void PrototypeStore::need_block(Index block) {
    auto& exact = exact_[static_cast<std::size_t>(block)];
    if (exact) return;
    exact = 1;
    needed_.push_back(block);
}

void PrototypeStore::need_all() {
    for (Index block = 0; block < blocks_in_use(); ++block) need_block(block);
}

void PrototypeStore::refine(float* distances) {
    if (needed_.empty()) return;
    compare_needed(distances);
    if (3 * estimated_ < blocks_in_use()) in_vain_ = wait_after_vain;
}

void PrototypeStore::compare_needed(float* distances) {
    const double share = 1.0F / static_cast<float>(cells_);
    for (std::size_t n = 0; n < needed_.size(); n += 2) {
        const Index first = needed_[n], second = needed_[std::min(n + 1, needed_.size() - 1)];
        list_cells(first, second);
        double sums[2 * lanes];
        float found[2 * lanes];
        add_two(blocks_.data() + first * cells_ * lanes, blocks_.data() + second * cells_ * lanes,
                counted_.begin(), counted_.size(), present_.data(), share, sums);
        std::transform(sums, sums + 2 * lanes, found, [](double sum) { return static_cast<float>(sum); });
        tell(first, found, distances);
        tell(second, found + lanes, distances);
    }
    estimated_ -= static_cast<Index>(needed_.size());
    needed_.clear();
}

/// Lists the cells that count for two blocks. (A number that is not finite is not 0.)
void PrototypeStore::list_cells(Index first, Index second) {
    counted_.list(used_by(first), used_by(second), active_.data());
}

/// Puts the distances of a block where they belong: 1 for prototypes without any activity.
void PrototypeStore::tell(Index block, const float* found, float* distances) const {
    const Index begin = block * lanes, left = std::min(lanes, size() - begin);
    const Index* const keys = &keys_[static_cast<std::size_t>(begin)];
    const std::uint8_t* const silent = &silent_[static_cast<std::size_t>(begin)];
    float told[lanes];
    for (Index l = 0; l < lanes; ++l) told[l] = silent[l] ? 1.0F : found[l];
    for (Index l = 0; l < left; ++l) distances[keys[l]] = told[l];
}

}  // namespace forage::contextual
