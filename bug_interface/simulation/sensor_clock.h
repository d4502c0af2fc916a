// When sensors look that have rates of their own.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/archive.h"

namespace forage::bug {

/// Look n is due at n * period; look 0 is taken at the start.
class SensorClock {
  public:
    /// `rate`: looks per second of the world, 0: as many as there are steps of `step` s.
    SensorClock(double rate, double step) : period_(rate > 0 ? 1 / rate : step) {}

    bool due(double now) const { return number(now) > last_; }  ///< `now`: s of the world
    /// The look that is due: its number, by which its noise is drawn.
    std::uint64_t look(double now) { return last_ = number(now); }

    void checkpoint(Archive& archive) { archive(last_); }

  private:
    std::uint64_t number(double now) const {
        return static_cast<std::uint64_t>(std::floor((now + 1e-9) / period_));
    }
    double period_;
    std::uint64_t last_ = 0;
};

}  // namespace forage::bug
