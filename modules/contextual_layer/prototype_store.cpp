#include "modules/contextual_layer/prototype_store.h"

#include <algorithm>
#include <cmath>

#include "core/types/simd.h"

namespace forage::contextual {
namespace {

template <Index lanes>
using CellsOf = Eigen::Map<Eigen::ArrayXf, 0, Eigen::InnerStride<lanes>>;  ///< of one prototype in its block

/// sum[l] += |cells[i][l] - present[i]| share for the `count` cells i that are named, in order, rounded to
/// single precision each time.
template <Index lanes>
[[gnu::always_inline]] inline void add_distances(const float* cells, const Index* named, std::size_t count,
                                                 const double* present, double share, double* sum) {
    double total[lanes];
    std::copy_n(sum, lanes, total);
    for (std::size_t j = 0; j < count; ++j) {
        const float* stored = cells + named[j] * lanes;
        const double here = present[named[j]];
        for (Index l = 0; l < lanes; ++l)
            total[l] = static_cast<float>(total[l] + std::abs(static_cast<double>(stored[l]) - here) * share);
    }
    std::copy_n(total, lanes, sum);
}

FORAGE_SIMD void add_sixteen(const float* cells, const Index* named, std::size_t count, const double* present,
                             double share, double* sum) {
    add_distances<16>(cells, named, count, present, share, sum);
}

}  // namespace

PrototypeStore::PrototypeStore(Index keys, Index capacity, Index cells)
    : cells_(cells),
      compared_(Eigen::ArrayXd::Zero(cells)),
      present_(Eigen::ArrayXd::Zero(cells)),
      worth_(static_cast<std::size_t>(cells) + 1) {
    const Index blocks = (capacity + lanes - 1) / lanes;
    blocks_.setZero(blocks * cells * lanes);
    used_.resize(static_cast<std::size_t>(blocks * cells), 0);
    silent_.resize(static_cast<std::size_t>(capacity), 0);
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
    CellsOf<lanes> cells(cells_of(slot), cells_);
    if (peak > 0)
        cells = prototype / peak;
    else
        cells.setZero();
    note_use(slot / lanes);
}

void PrototypeStore::remove(Index key) {
    current_ = false;
    const Index slot = slots_[static_cast<std::size_t>(key)], last = size() - 1;
    using Cells = CellsOf<lanes>;
    if (slot != last) {  // the last one moves into the gap
        Cells(cells_of(slot), cells_) = Cells(cells_of(last), cells_);
        silent_[static_cast<std::size_t>(slot)] = silent_[static_cast<std::size_t>(last)];
        keys_[static_cast<std::size_t>(slot)] = keys_.back();
        slots_[static_cast<std::size_t>(keys_.back())] = slot;
        note_use(slot / lanes);
    }
    Cells(cells_of(last), cells_).setZero();
    note_use(last / lanes);
    keys_.pop_back();
}

void PrototypeStore::note_use(Index block) {
    for (Index i = 0; i < cells_; ++i) {
        const Index cell = block * cells_ + i;
        used_[static_cast<std::size_t>(cell)] = (blocks_.segment<lanes>(cell * lanes) != 0.0F).any();
    }
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
    for (Index first = 0; first < size(); first += lanes) {
        const Lanes sums = distances_of(first / lanes);
        const Index end = std::min(first + lanes, size());
        for (Index slot = first; slot < end; ++slot)
            distances[keys_[static_cast<std::size_t>(slot)]] =
                silent_[static_cast<std::size_t>(slot)] ? 1.0F : static_cast<float>(sums[slot - first]);
    }
}

PrototypeStore::Lanes PrototypeStore::distances_of(Index block) {
    // Cells that are 0 on both sides add nothing.
    const std::uint8_t* used = used_.data() + block * cells_;
    std::size_t count = 0;
    for (Index i = 0; i < cells_; ++i) {
        worth_[count] = i;
        count += used[i] | (present_[i] != 0);
    }
    Lanes sum = Lanes::Zero();  // of single-precision numbers
    static_assert(lanes == 16);
    add_sixteen(blocks_.data() + block * cells_ * lanes, worth_.data(), count, present_.data(),
                1.0F / static_cast<float>(cells_), sum.data());
    return sum;
}

}  // namespace forage::contextual
