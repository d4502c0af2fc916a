// A line that shows the progress of a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace forage::tool {

/// Redraws one line on a terminal, at most ten times a second. Draws nothing when the output is not a
/// terminal.
class Progress {
  public:
    explicit Progress(bool wanted);
    ~Progress() { clear(); }

    struct State {
        double done = 0;  ///< fraction of the run, 0..1
        std::uint64_t cycles = 0;
        double seconds = 0;  ///< seconds of the world
        std::string text;    ///< further text; may be empty
    };
    /// Whether it is time to redraw.
    bool due() const { return shown_ && std::chrono::steady_clock::now() >= next_; }
    void draw(const State& state);
    /// Draws a bar for the fraction `done`, 0..1, and a text.
    void draw(double done, const std::string& text);
    void clear();
    /// Wall-clock time since the start, s.
    double elapsed() const;

  private:
    bool shown_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), next_ = start_;
};

}  // namespace forage::tool
