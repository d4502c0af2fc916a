#include "modules/devices/video/child_process.h"

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace forage::video {

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
    std::vector<char*> words;
    for (const auto& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C is not for it
    const int error = posix_spawnp(&process_, words[0], &files, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
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
    if (!status_) kill(process_, SIGKILL);
    succeeded();
}

bool ChildProcess::succeeded() {
    while (!status_) {
        int status = 0;
        const auto done = waitpid(process_, &status, 0);
        if (done >= 0 || errno != EINTR) status_ = done >= 0 ? status : -1;
    }
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
