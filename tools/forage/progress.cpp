#include "tools/forage/progress.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/base/printable.h"

namespace forage::tool {

namespace {

bool can_redraw() {
    const char* term = std::getenv("TERM");
    return isatty(STDERR_FILENO) && term && std::string_view(term) != "dumb";
}

}  // namespace

Progress::Progress(bool wanted) : shown_(wanted && can_redraw()) {}

double Progress::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::draw(const State& s) {
    const double elapsed = std::max(this->elapsed(), 1e-9);
    draw(s.done, fmt::format("{}{}{:.0f} x real time  {:.0f} cycles/s", s.text, s.text.empty() ? "" : "  ",
                             s.seconds / elapsed, static_cast<double>(s.cycles) / elapsed));
}

void Progress::draw(double part, const std::string& what) {
    next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    const double done = std::clamp(part, 0.0, 1.0);
    const std::string text = fmt::format("{:3.0f} %  {}", 100 * done, what);
    winsize size{};
    const int columns =
        ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1 : 79;
    // The bar takes the width that the text leaves, if that is enough for a bar.
    const int width = std::min(columns - static_cast<int>(text.size()) - 3, 40);
    const int filled = static_cast<int>(done * width);
    std::string line = width < 5 ? text.substr(0, static_cast<std::size_t>(columns))
                                 : fmt::format("[{:=<{}}{:{}}] {}", "", filled, "", width - filled, text);
    fmt::print(stderr, "\r{}\x1b[K", printable(line));
    std::fflush(stderr);
}

void Progress::clear() {
    if (!shown_) return;
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

}  // namespace forage::tool
