#include "modules/contextual_layer/long_term_memory.h"

#include <algorithm>

namespace forage::contextual {

LongTermMemory::LongTermMemory(Index sequences, Index segments, Index prototype_cells, Index action_cells)
    : longest_(std::min(sequences, segments)),
      prototypes_(sequences * segments, sequences * longest_, prototype_cells),
      actions_(Eigen::ArrayXXf::Zero(action_cells, sequences * longest_)),
      lengths_(static_cast<std::size_t>(sequences), 0),
      distance_(SegmentArray::Ones(sequences, segments)),
      collector_(SegmentArray::Zero(sequences, segments)),
      trigger_(SegmentArray::Zero(sequences, segments)),
      selected_(SegmentArray::Zero(sequences, segments)) {}

void LongTermMemory::store(const ShortTermMemory& memory) {
    const Index row = next_, length = std::min(memory.size(), longest_);
    for (Index column = 0; column < this->length(row); ++column)
        prototypes_.remove(row * segments() + column);
    for (Index column = 0; column < length; ++column) {
        prototypes_.add(row * segments() + column, memory.prototype(column));
        actions_.col(row * longest_ + column) = memory.action(column);
    }
    lengths_[static_cast<std::size_t>(row)] = length;
    distance_.row(row).setOnes();
    collector_.row(row).setZero();
    selected_.row(row).setZero();
    trigger_.row(row).setZero();
    trigger_.row(row).head(length).setOnes();
    next_ = (row + 1) % sequences();
}

void LongTermMemory::decay_triggers(float decay) {
    const float kept = 1 - decay;
    for (Index row = 0; row < sequences(); ++row) {
        auto t = trigger_.row(row).head(length(row));
        t = (t > 1.0F).select(kept * t + decay, 1.0F);
    }
}

void LongTermMemory::compare(const Eigen::Ref<const Eigen::ArrayXd>& prototype) {
    prototypes_.compare(prototype, distance_.data());
    for (Index row = 0; row < sequences(); ++row) {
        const Index n = length(row);
        collector_.row(row).head(n) = (1.0F - distance_.row(row).head(n)) * trigger_.row(row).head(n);
    }
}

}  // namespace forage::contextual
