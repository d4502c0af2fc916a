// How fast a run goes.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace forage::studio {

/// The time of a steady clock, s.
inline double clock_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds the time until its end to a sum, s.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch() { sum_ += clock_now() - begun_; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& sum_;
    double begun_ = clock_now();
};

/// Says when the next cycle is due, and measures cycles per second.
class Pace {
  public:
    bool running = false;
    double pages_time = 0;  ///< s that pages took since the last measurement

    /// As fast as the world ("real"), `value` times as fast ("times"), `value` cycles per second ("cycles"),
    /// or as fast as possible ("free").
    void set(const std::string& mode, double value) { mode_ = mode, value_ = value, from_ = -1; }
    const std::string& mode() const { return mode_; }
    double value() const { return value_; }

    /// The run continues after a pause, or from another cycle: nothing is due from before.
    void restart() { from_ = measured_from_ = -1; }
    /// The run is started: nothing is measured yet.
    void start() { restart(), measured_rate_ = 0; }
    /// Begins to count at a cycle after restart().
    void begin(double now, std::uint64_t cycle) {
        if (measured_from_ < 0) begin_measurement(now, cycle);
        if (from_ < 0) from_ = now, cycle_ = cycle;
    }
    /// Cycles per second that are wanted; 0 for as many as possible.
    double rate(double seconds_per_cycle) const {
        if (mode_ == "free") return 0;
        if (mode_ == "cycles") return value_;
        return (mode_ == "times" ? value_ : 1) / seconds_per_cycle;
    }
    /// When a cycle is due.
    double due(std::uint64_t cycle, double rate) const {
        return from_ + static_cast<double>(cycle - cycle_) / rate;
    }
    /// Whether a cycle is due. A run that is far behind does not catch up.
    bool is_due(double now, std::uint64_t cycle, double rate) {
        if (rate <= 0) return true;
        const double when = due(cycle, rate);
        if (now - when > max_behind) from_ = now, cycle_ = cycle;
        return when <= now;
    }
    void measure(double now, std::uint64_t cycle) {
        const double passed = now - measured_from_;
        if (passed <= 0.5) return;
        measured_rate_ = static_cast<double>(cycle - measured_cycle_) / passed;
        pages_share_ = std::min(1., pages_time / passed);
        begin_measurement(now, cycle);
    }
    double measured_rate() const { return measured_rate_; }  ///< cycles per second
    double pages_share() const { return pages_share_; }      ///< the part of the time that pages take

  private:
    static constexpr double max_behind = 0.25;  ///< s

    void begin_measurement(double now, std::uint64_t cycle) {
        measured_from_ = now, measured_cycle_ = cycle, pages_time = 0;
    }

    std::string mode_ = "real";
    double value_ = 1;
    double from_ = -1, measured_from_ = -1;
    std::uint64_t cycle_ = 0, measured_cycle_ = 0;
    double measured_rate_ = 0, pages_share_ = 0;
};

}  // namespace forage::studio
