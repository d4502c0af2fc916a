#include "tools/forage/stop.h"

#include <atomic>
#include <cerrno>
#include <csignal>

#include <unistd.h>

namespace forage::tool {
namespace {

constexpr std::uint64_t no_number = -1;

volatile std::sig_atomic_t noted = 0;
const char* finishing = "";
std::atomic<std::uint64_t> cycle_number = no_number;
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);  // as a signal handler needs it

/// A line that is written in a signal handler, where nothing can be allocated.
class Line {
  public:
    Line& operator<<(const char* text) {
        for (; *text && size_ < sizeof text_; ++text) text_[size_++] = *text;
        return *this;
    }
    Line& operator<<(std::uint64_t number) {
        char digits[21] = {};
        char* first = digits + sizeof digits - 1;
        do *--first = static_cast<char>('0' + number % 10);
        while (number /= 10);
        return *this << first;
    }
    void write() const { [[maybe_unused]] const auto n = ::write(STDERR_FILENO, text_, size_); }

  private:
    char text_[200];
    std::size_t size_ = 0;
};

extern "C" void note(int signal) {
    const int error = errno;
    noted = signal;
    std::signal(signal, SIG_DFL);
    Line line;
    if (isatty(STDERR_FILENO)) line << "\n";  // behind the progress bar
    line << "finishing " << finishing;
    if (cycle_number != no_number) line << " " << cycle_number;
    line << (signal == SIGINT ? "; Ctrl-C" : "; SIGTERM") << " again ends at once\n";
    line.write();
    errno = error;
}

}  // namespace

void note_signals(const char* what) {
    finishing = what;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error like a full disk
}

void note_cycle(std::uint64_t cycle) { cycle_number = cycle; }

int noted_signal() { return noted; }

std::string stopped_by(int signal) { return signal == SIGINT ? "by Ctrl-C" : "by SIGTERM"; }

}  // namespace forage::tool
