// Whether threads make a loop faster, by trying.
#pragma once

#include <array>
#include <chrono>

namespace forage::engine {

/// A loop that threads can share is faster for it when it takes long and a processor is free, which nobody
/// can tell beforehand. So it is run both ways for a while, and then in the faster one until the next trial.
/// The numbers are the same either way.
class SharingTrial {
  public:
    /// Begins a run; whether to share it.
    bool begin() {
        shared_ = count_ < each ? true : count_ < 2 * each ? false : pays_;
        if (count_ < 2 * each) start_ = Clock::now();
        return shared_;
    }
    void end() {
        if (count_ < 2 * each)
            seconds_[shared_] += std::chrono::duration<double>(Clock::now() - start_).count();
        if (++count_ == 2 * each) pays_ = seconds_[true] < seconds_[false];
        if (count_ == period) count_ = 0, seconds_ = {};
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr int each = 16, period = 4096;  // runs

    int count_ = 0;
    bool shared_ = true, pays_ = true;
    std::array<double, 2> seconds_{};
    Clock::time_point start_;
};

}  // namespace forage::engine
