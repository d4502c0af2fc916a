// The number of processor cores.
#pragma once

#include <algorithm>
#include <thread>

#include <sched.h>

namespace forage {

/// The number of cores that this process may use (limited by taskset or a container), at least 1.
inline int cores() {
    cpu_set_t usable;  // up to 1,024 cores; std::thread::hardware_concurrency() counts all of the machine
    if (sched_getaffinity(0, sizeof usable, &usable) == 0) return std::max(1, CPU_COUNT(&usable));
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace forage
