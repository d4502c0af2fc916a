// Finds out by trials whether threads make a loop faster.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace forage::engine {

/// Decides whether threads share a piece of work that is done again and again. Sharing pays when the work
/// takes long and a processor is free, which cannot be known beforehand and which changes. So the tuner lets
/// the work be done both ways for a while, and then in the faster way until the next trial. The next trial
/// comes at once when sharing has become clearly slower than working alone. The results are the same either
/// way. Gain (docs/design/performance.md): two threads are up to 1.9 times as fast as one, and small systems,
/// which threads made up to 8 times slower, keep their speed.
template <class Clock = std::chrono::steady_clock>
class ParallelTuner {
  public:
    /// Begins a run of the work. Returns whether to share it. There is no trial unless `worth()` says that
    /// one is worth its time.
    template <class Worth>
    bool begin(Worth worth) {
        if (count_ == 0 && !worth()) settle(false);
        running_ = true;
        shared_ = count_ < each ? false : count_ < 2 * each || pays_;
        timed_ = shared_ || count_ < each;
        if (timed_) start_ = Clock::now();
        return shared_;
    }
    /// Ends the run, if one was begun.
    void end() {
        if (!std::exchange(running_, false)) return;
        if (timed_) note(std::chrono::duration<double>(Clock::now() - start_).count());
        if (++count_ >= period_) count_ = 0;
    }

  private:
    static constexpr int each = 16, shortest = 512, longest = 4096;  // runs
    static constexpr double often = 2;       // s, from one trial to the next, as far as that is so many runs
    static constexpr double clearly = 0.93;  // what is gained by less may be chance, and takes a processor
    static constexpr double slower = 1.1;    // a few runs scatter
    static constexpr double enough = 0.02;   // of a period's time, or 32 runs: what a trial may take
    using Times = std::array<double, each>;

    void settle(bool pays) {
        pays_ = pays;
        count_ = 2 * each;
    }
    void note(double seconds) {
        const int i = count_ % each;
        (shared_ ? with_ : without_)[static_cast<std::size_t>(i)] = seconds;
        if (!shared_) {
            period_ = static_cast<int>(std::clamp(often / seconds, double{shortest}, double{longest}));
            return;
        }
        spent_ = i == 0 ? seconds : spent_ + seconds;
        const bool trying = count_ < 2 * each, whole = i == each - 1;
        if (trying && spent_ > std::max(enough * period_, 2.0 * each) * median(without_))
            settle(false), period_ = longest;
        else if (whole && trying)
            pays_ = median(with_) < clearly * median(without_);
        else if (whole && median(with_) > slower * median(without_))
            count_ = period_;
    }
    static double median(Times times) {  // the first runs wake threads up, some are interrupted
        std::nth_element(times.begin(), times.begin() + each / 2, times.end());
        return times[each / 2];
    }

    int period_ = longest;
    int count_ = 0;  ///< of this period: at first without sharing, then with it, then as it pays
    bool running_ = false, shared_ = false, timed_ = false, pays_ = true;
    double spent_ = 0;  ///< by the last runs that were shared, of `each`
    Times with_{}, without_{};
    typename Clock::time_point start_;
};

}  // namespace forage::engine
