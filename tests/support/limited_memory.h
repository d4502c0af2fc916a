// Limits the memory of a test.
#pragma once

#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace forage::test {

#ifdef FORAGE_SANITIZED
inline constexpr bool can_limit_memory = false;  // sanitizers map the whole address space
#else
inline constexpr bool can_limit_memory = true;
#endif

/// During its lifetime, the program can allocate at most this many additional bytes.
class LimitedMemory {
  public:
    explicit LimitedMemory(std::size_t more) {
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        getrlimit(RLIMIT_AS, &before_);
        rlimit limit = before_;
        limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
        setrlimit(RLIMIT_AS, &limit);
    }
    ~LimitedMemory() { setrlimit(RLIMIT_AS, &before_); }
    LimitedMemory(const LimitedMemory&) = delete;
    LimitedMemory& operator=(const LimitedMemory&) = delete;

  private:
    rlimit before_{};
};

}  // namespace forage::test
