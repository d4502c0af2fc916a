// Counts hits among trials that follow each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/estimate.h"

namespace forage {

/// How many trials a point of a learning curve is the mean of.
constexpr std::size_t learning_window = 20;

/// Which of many trials were hits. Those in any part of them are counted at once.
class HitCounts {
  public:
    void add(bool hit) { until_.push_back(until_.back() + hit); }
    void clear() { until_.resize(1); }
    std::size_t size() const { return until_.size() - 1; }
    /// The hits among the trials from `from` up to `to`, without the latter; both count from 0.
    std::size_t among(std::size_t from, std::size_t to) const { return until_[to] - until_[from]; }
    /// The point of the learning curve after `count` trials, at least 1: the share of the last ones.
    Estimate learned(std::size_t count) const {
        const std::size_t from = count - std::min(count, learning_window);
        return share(among(from, count), count - from);
    }

  private:
    std::vector<std::uint32_t> until_ = {0};  ///< hits before each trial, and of all
};

}  // namespace forage
