// What the machine offers.
#pragma once

#include <algorithm>
#include <thread>

#include <sched.h>

namespace forage {

/// That this process may use (taskset, a container), at least 1.
inline int cores() {
    cpu_set_t usable;  // of up to 1,024; std::thread::hardware_concurrency() counts all
    if (sched_getaffinity(0, sizeof usable, &usable) == 0) return std::max(1, CPU_COUNT(&usable));
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace forage
