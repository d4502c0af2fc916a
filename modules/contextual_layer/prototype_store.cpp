#include "modules/contextual_layer/prototype_store.h"

#include <algorithm>
#include <cmath>

#include "core/base/simd.h"

namespace forage::contextual {
namespace {

using CellsOf =
    Eigen::Map<Eigen::ArrayXd, 0, Eigen::InnerStride<lanes>>;  ///< the cells of one prototype in its block

/// sums[b][l] = the sum of |cells_b[i][l] - present[i]| share over the `count` listed cells i, for two
/// blocks. The sum is rounded to single precision after each addition. Rounding has a long latency; with two
/// blocks, one is computed while the other is rounded. A single block is passed twice, as GCC 12 does not
/// vectorise other forms of this loop correctly.
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
      listed_(cells) {
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
    note_used(slot / lanes);
}

void PrototypeStore::remove(Index key) {
    current_ = false;
    const Index slot = slots_[static_cast<std::size_t>(key)], last = size() - 1;
    if (slot != last) {  // the last prototype moves into the gap
        CellsOf(cells_of(slot), cells_) = CellsOf(cells_of(last), cells_);
        silent_[static_cast<std::size_t>(slot)] = silent_[static_cast<std::size_t>(last)];
        keys_[static_cast<std::size_t>(slot)] = keys_.back();
        slots_[static_cast<std::size_t>(keys_.back())] = slot;
        note_used(slot / lanes);
    }
    CellsOf(cells_of(last), cells_).setZero();
    note_used(last / lanes);
    keys_.pop_back();
}

/// Finds the cells of a block that are not 0 in some lane.
void PrototypeStore::note_used(Index block) {
    std::uint64_t* used = &used_[static_cast<std::size_t>(block * words_)];
    std::fill_n(used, words_, 0);
    for (Index i = 0; i < cells_; ++i)
        if ((blocks_.segment<lanes>((block * cells_ + i) * lanes) != 0.0).any())
            used[i / cells_per_word] |= std::uint64_t{1} << (i % cells_per_word);
}

/// Sets p. Returns false when no comparison is necessary, because the distances in the array are already
/// those of p.
bool PrototypeStore::set_present(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    if (current_ && (present == compared_).all()) return false;
    current_ = true;
    compared_ = present;
    const double peak = static_cast<float>(std::max(0.0, present.maxCoeff()));
    if (!(peak > 0)) {
        for (const Index key : keys_) distances[key] = 1;
        return false;
    }
    present_ = present / peak;
    std::ranges::fill(active_, 0);
    for (Index i = 0; i < cells_; ++i)
        if (present_[i] != 0)
            active_[static_cast<std::size_t>(i / cells_per_word)] |= std::uint64_t{1} << (i % cells_per_word);
    return true;
}

void PrototypeStore::compare(const Eigen::Ref<const Eigen::ArrayXd>& present, float* distances) {
    if (!set_present(present, distances)) return;
    const double share = 1.0F / static_cast<float>(cells_);
    for (Index first = 0; first < blocks_in_use(); first += 2) {
        const Index second = std::min(first + 1, blocks_in_use() - 1);
        list_cells(first, second);
        double sums[2 * lanes];
        float found[2 * lanes];
        add_two(blocks_.data() + first * cells_ * lanes, blocks_.data() + second * cells_ * lanes,
                listed_.begin(), listed_.size(), present_.data(), share, sums);
        std::transform(sums, sums + 2 * lanes, found, [](double sum) { return static_cast<float>(sum); });
        write_distances(first, found, distances);
        write_distances(second, found + lanes, distances);
    }
}

/// Lists the cells that contribute to the distances of two blocks. Infinite numbers and NaN contribute.
void PrototypeStore::list_cells(Index first, Index second) {
    listed_.list(used_by(first), used_by(second), active_.data());
}

/// Writes the distances of a block to the array, with 1 for prototypes without activity.
void PrototypeStore::write_distances(Index block, const float* found, float* distances) const {
    const Index begin = block * lanes, left = std::min(lanes, size() - begin);
    const Index* const keys = &keys_[static_cast<std::size_t>(begin)];
    const std::uint8_t* const silent = &silent_[static_cast<std::size_t>(begin)];
    float values[lanes];
    for (Index l = 0; l < lanes; ++l) values[l] = silent[l] ? 1.0F : found[l];
    for (Index l = 0; l < left; ++l) distances[keys[l]] = values[l];
}

}  // namespace forage::contextual
