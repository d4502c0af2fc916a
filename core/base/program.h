// Programs that are started.
#pragma once

#include <cerrno>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace forage {

/// The files that are the standard streams of a program.
struct Streams {
    static constexpr int inherited = -1, nothing = -2;
    int in = inherited, out = inherited, error = inherited;
};

/// Starts `words[0]`, which is searched in PATH, and sets the id of its process. Ctrl-C in the terminal does
/// not reach a program that is `apart`. Returns 0, or the number of an error.
inline int start_program(int& id, const std::vector<std::string>& words, const Streams& streams, bool apart) {
    std::vector<char*> arguments;
    for (const auto& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    int to = STDIN_FILENO;
    for (const int file : {streams.in, streams.out, streams.error}) {
        if (file == Streams::nothing) posix_spawn_file_actions_addopen(&files, to, "/dev/null", O_RDWR, 0);
        if (file >= 0) posix_spawn_file_actions_adddup2(&files, file, to);
        ++to;
    }
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    if (apart) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = posix_spawnp(&id, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

/// Waits for the end of a process. Returns its exit status; -1 when it was killed.
inline int exit_status(int id) {
    int status = -1;
    while (waitpid(id, &status, 0) < 0)
        if (errno != EINTR) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace forage
