// A line that shows how a run goes.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace forage::tool {

/// Redraws one line on a terminal, at most ten times a second; draws nothing elsewhere.
class Progress {
  public:
    explicit Progress(bool wanted);
    ~Progress() { clear(); }

    struct State {
        double done = 0;  ///< part of the run, 0..1
        std::uint64_t cycles = 0;
        double seconds = 0;  ///< of the world
        std::string text;    ///< what else there is to say
    };
    /// Whether it is time to redraw.
    bool due() const { return shown_ && std::chrono::steady_clock::now() >= next_; }
    void draw(const State& state);
    /// A bar for `done`, 0..1, and a text.
    void draw(double done, const std::string& text);
    void clear();
    /// s of the clock since the start.
    double elapsed() const;

  private:
    bool shown_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), next_ = start_;
};

}  // namespace forage::tool
