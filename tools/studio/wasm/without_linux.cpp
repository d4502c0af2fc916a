// What a browser has not: processes (ffmpeg, a compiler), of which the caller gets an error, and a number of
// cores.
#include <cerrno>

#include <sched.h>
#include <spawn.h>

extern "C" {

int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const[], char* const[]) {
    return ENOSYS;
}

int sched_getaffinity(pid_t, size_t, cpu_set_t*) { return -1; }
int __sched_cpucount(size_t, const cpu_set_t*) { return 1; }
}
