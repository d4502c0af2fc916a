#include "tools/plot/mp4.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/base/program.h"

namespace forage::plot {

bool has_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::string_view rest = path ? path : "";
    while (!rest.empty()) {
        const auto folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
        if (access(fmt::format("{}/ffmpeg", folder).c_str(), X_OK) == 0) return true;
    }
    return false;
}

void Mp4File::start(const Pixels& frame) {
    const std::string size = fmt::format("{}x{}", frame.width, frame.height);
    const std::string rate = fmt::format("{}", 1 / seconds_per_frame_), part = name_ + ".part";
    // Players need even sizes and yuv420p. "file:" keeps ffmpeg from reading a protocol into the name.
    const std::vector<std::string> words = {
        "ffmpeg",   "-loglevel",   "error",     "-y",
        "-f",       "rawvideo",    "-pix_fmt",  "bgr0",
        "-s",       size,          "-r",        rate,
        "-i",       "-",           "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
        "-pix_fmt", "yuv420p",     "-bitexact", "-f",
        "mp4",      "file:" + part};
    int ends[2];  // of a socket instead of a pipe: when ffmpeg has ended, writing is an error and no signal
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::system_error(errno, std::generic_category(), "a socket");
    // Apart, because Ctrl-C ends the run, and then the film.
    const int error = start_program(process_, words, {.in = ends[1], .out = STDERR_FILENO}, true);
    close(ends[1]);
    socket_ = ends[0];
    if (error == 0) return;
    process_ = -1;
    close(socket_), socket_ = -1;
    throw std::runtime_error(
        fmt::format("'{}': ffmpeg does not start: {}", name_, std::generic_category().message(error)));
}

void Mp4File::add(const Pixels& frame) {
    if (process_ < 0) start(frame);
    for (int y = 0; y < frame.height; ++y) {
        const auto* row =
            reinterpret_cast<const char*>(frame.rgb + static_cast<std::size_t>(y) * frame.stride);
        const std::size_t size = 4 * static_cast<std::size_t>(frame.width);
        for (std::size_t sent = 0; sent < size;) {
            const auto n = send(socket_, row + sent, size - sent, MSG_NOSIGNAL);
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) throw std::runtime_error(fmt::format("'{}': ffmpeg does not take the film", name_));
            sent += static_cast<std::size_t>(n);
        }
    }
}

bool Mp4File::end() {
    close(socket_);
    const int status = exit_status(process_);
    process_ = socket_ = -1;
    return status == 0;
}

void Mp4File::finish() {
    if (process_ < 0) return;
    const std::string part = name_ + ".part";
    if (end() && std::rename(part.c_str(), name_.c_str()) == 0) return;
    std::remove(part.c_str());
    throw std::runtime_error(fmt::format("'{}': ffmpeg did not write the film", name_));
}

Mp4File::~Mp4File() {
    if (process_ < 0) return;
    end();
    std::remove((name_ + ".part").c_str());
}

}  // namespace forage::plot
