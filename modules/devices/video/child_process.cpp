#include "modules/devices/video/child_process.h"

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "core/base/program.h"

namespace forage::video {

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
    const int error = start_program(process_, arguments, {.in = Streams::nothing, .out = ends[1]}, true);
    close(ends[1]);
    pipe_ = ends[0];
    if (error == 0) return;
    close(pipe_);
    throw std::runtime_error(
        error == ENOENT
            ? fmt::format("the program {} is not installed (Debian and Ubuntu: apt-get install {})",
                          arguments[0], arguments[0])
            : fmt::format("{}: {}", arguments[0], std::generic_category().message(error)));
}

ChildProcess::~ChildProcess() {
    close(pipe_);
    if (status_) return;
    kill(process_, SIGKILL);
    exit_status(process_);
}

bool ChildProcess::succeeded() {
    if (!status_) status_ = exit_status(process_);
    return *status_ == 0;
}

std::optional<std::string> ChildProcess::read(int milliseconds) {
    pollfd what{pipe_, POLLIN, 0};
    int found = 0;
    do found = poll(&what, 1, milliseconds);
    while (found < 0 && errno == EINTR);  // Ctrl-C, or a terminal of another size
    if (found <= 0) return std::nullopt;
    std::string out(1 << 16, '\0');
    const auto size = ::read(pipe_, out.data(), out.size());
    if (size < 0 && errno == EINTR) return std::nullopt;
    if (size < 0) throw std::system_error(errno, std::generic_category(), "reading pictures");
    out.resize(static_cast<std::size_t>(size));
    return out;
}

}  // namespace forage::video
