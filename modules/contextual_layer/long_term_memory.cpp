#include "modules/contextual_layer/long_term_memory.h"

#include <algorithm>
#include <bit>

#include "core/base/simd.h"

namespace forage::contextual {
namespace {

/// The maximum of numbers that are not negative: their bits are ordered as the numbers are. NaN is the
/// largest.
class Largest {
  public:
    void note(float x) { bits_ = std::max(bits_, std::bit_cast<std::int32_t>(x)); }
    float value() const { return std::bit_cast<float>(bits_); }

  private:
    std::int32_t bits_ = 0;
};

float positive(float x) { return x > 0.0F ? x : 0.0F; }

/// Updates the triggers and collectors of a row, see LongTermMemory::collect(). Returns the largest
/// collector, or 0 if none is above 0.
FORAGE_SIMD float collect_row(const float* distance, Index n, float decay, float* trigger, float* collector) {
    const float kept = 1 - decay;
    Largest peak;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < n; ++i) {
        const float before = trigger[i], decayed = kept * before + decay;
        const float t = before > 1.0F ? decayed : 1.0F;
        const float c = (1.0F - distance[i]) * t;
        trigger[i] = t;
        collector[i] = c;
        peak.note(positive(c));
    }
    return peak.value();
}

}  // namespace

LongTermMemory::LongTermMemory(Index sequences, Index segments, Index prototype_cells, Index action_cells)
    : max_length_(std::min(sequences, segments)),
      prototypes_(sequences * segments, sequences * max_length_, prototype_cells),
      actions_(Eigen::ArrayXXf::Zero(action_cells, sequences * max_length_)),
      lengths_(static_cast<std::size_t>(sequences), 0),
      distance_(SegmentArray::Ones(sequences, segments)),
      collector_(SegmentArray::Zero(sequences, segments)),
      trigger_(SegmentArray::Zero(sequences, segments)),
      selected_(SegmentArray::Zero(sequences, segments)),
      peaks_(static_cast<std::size_t>(sequences), 0),
      has_selection_(static_cast<std::size_t>(sequences), 0) {}

void LongTermMemory::store(const ShortTermMemory& memory) {
    const Index row = next_, length = std::min(memory.size(), max_length_);
    for (Index column = 0; column < this->length(row); ++column)
        prototypes_.remove(row * segments() + column);
    for (Index column = 0; column < length; ++column) {
        prototypes_.add(row * segments() + column, memory.prototype(column));
        actions_.col(row * max_length_ + column) = memory.action(column);
    }
    lengths_[static_cast<std::size_t>(row)] = length;
    distance_.row(row).setOnes();
    collector_.row(row).setZero();
    selected_.row(row).setZero();
    has_selection(row) = false;
    trigger_.row(row).setZero();
    trigger_.row(row).head(length).setOnes();
    next_ = (row + 1) % sequences();
}

void LongTermMemory::compare(const Eigen::Ref<const Eigen::ArrayXd>& prototype) {
    prototypes_.compare(prototype, distance_.data());
}

void LongTermMemory::collect(float decay) {
    for (Index row = 0; row < sequences(); ++row) {
        const Index first = row * segments();
        peaks_[static_cast<std::size_t>(row)] = collect_row(
            distance_.data() + first, length(row), decay, trigger_.data() + first, collector_.data() + first);
    }
}

}  // namespace forage::contextual
