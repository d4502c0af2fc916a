// The sample times of a sensor that has a rate of its own.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/archive.h"

namespace forage::bug {

/// Sample n is due at time n * period. Sample 0 is taken at the start.
class SensorClock {
  public:
    /// `rate` is the number of samples per second of simulated time; 0 stands for one sample per time step of
    /// `step` s.
    SensorClock(double rate, double step) : period_(rate > 0 ? 1 / rate : step) {}

    /// Whether a sample is due at the simulated time `now`, s.
    bool due(double now) const { return number(now) > last_; }
    /// Takes the sample that is due at `now`. Returns its number, which selects its noise.
    std::uint64_t sample(double now) { return last_ = number(now); }

    void checkpoint(Archive& archive) { archive(last_); }

  private:
    std::uint64_t number(double now) const {
        return static_cast<std::uint64_t>(std::floor((now + 1e-9) / period_));
    }
    double period_;           ///< s
    std::uint64_t last_ = 0;  ///< number of the last sample
};

}  // namespace forage::bug
