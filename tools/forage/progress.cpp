#include "tools/forage/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace forage::tool {

Progress::Progress(bool wanted) : shown_(wanted && isatty(STDERR_FILENO)) {}

double Progress::elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void Progress::draw(const State& s) {
    next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    constexpr int width = 24;
    const int filled = static_cast<int>(std::clamp(s.done, 0.0, 1.0) * width);
    const double elapsed = std::max(this->elapsed(), 1e-9);
    std::string line = fmt::format("[{:=<{}}{:{}}] {:3.0f} %  {:.0f} cycles/s  {:.0f} x real time  {}", "", filled, "", width - filled,
                                   100 * std::clamp(s.done, 0.0, 1.0), static_cast<double>(s.cycles) / elapsed, s.seconds / elapsed, s.text);
    winsize size{};
    const std::size_t columns = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
    line.resize(std::min(line.size(), columns));
    fmt::print(stderr, "\r{}\x1b[K", line);
    std::fflush(stderr);
}

void Progress::clear() {
    if (!shown_) return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

}  // namespace forage::tool
