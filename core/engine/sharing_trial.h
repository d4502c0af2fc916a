// Whether threads make a loop faster, by trying.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace forage::engine {

/// Work that threads can share is faster for it when it takes long and a processor is free, which nobody can
/// tell beforehand. So it is done both ways for a while, and then in the faster one until the next trial. The
/// numbers are the same either way.
class SharingTrial {
  public:
    /// Begins a run; whether to share it. `worth()` is asked before a trial: without it there is none.
    template <class Worth>
    bool begin(Worth worth) {
        running_ = true;
        if (count_ == 0 && !worth()) count_ = 2 * each, pays_ = false;
        if (count_ >= 2 * each) return pays_;
        start_ = Clock::now();
        return shared();
    }
    /// Ends the run, if one was begun.
    void end() {
        if (!std::exchange(running_, false)) return;
        if (count_ < 2 * each) {
            seconds_[shared()][static_cast<std::size_t>(count_ % each)] =
                std::chrono::duration<double>(Clock::now() - start_).count();
            if (count_ == 2 * each - 1) pays_ = median(seconds_[true]) < clearly * median(seconds_[false]);
        }
        if (++count_ == period) count_ = 0;
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr int each = 16, period = 4096;  // runs
    static constexpr double clearly = 0.93;  // what is gained by less may be chance, and takes a processor
    using Times = std::array<double, each>;

    bool shared() const { return count_ < each; }  ///< in a trial
    static double median(Times times) {            // the first runs wake threads up, some are interrupted
        std::nth_element(times.begin(), times.begin() + each / 2, times.end());
        return times[each / 2];
    }

    int count_ = 0;
    bool running_ = false, pays_ = true;
    std::array<Times, 2> seconds_{};
    Clock::time_point start_;
};

}  // namespace forage::engine
