// Counts the allocations of a program: operator new, Eigen, and the libraries that it uses. It replaces
// the C library's functions, so only one file of a test program includes it.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <Eigen/Core>

#include "tests/support/catch.h"

namespace forage::test {

inline std::atomic<std::size_t> allocation_count{0};

/// The number of allocations so far, by all threads and libraries.
inline std::size_t allocations() { return allocation_count; }

}  // namespace forage::test

#if defined(__GLIBC__) && !defined(FORAGE_SANITIZED)

namespace forage::test {
inline constexpr bool counts_allocations = true;
}

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) noexcept { return ++forage::test::allocation_count, __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) noexcept {
    return ++forage::test::allocation_count, __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t size) noexcept {
    return ++forage::test::allocation_count, __libc_realloc(p, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
    return ++forage::test::allocation_count, __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    return ++forage::test::allocation_count, __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
    ++forage::test::allocation_count;
    void* p = __libc_memalign(alignment, size);
    if (!p) return ENOMEM;
    return *out = p, 0;
}
}

TEST_CASE("Counting sees operator new, Eigen's temporaries and aligned memory") {
    const volatile Eigen::Index size = 100;  // unknown to the compiler, which could remove the allocations
    const auto counted = [](auto allocate) {
        const std::size_t before = forage::test::allocations();
        allocate();
        return forage::test::allocations() - before;
    };
    double sum = 0;
    CHECK(counted([&] { sum += (Eigen::ArrayXd::Ones(size) * 2).eval()[0]; }) == 1);
    CHECK(counted([&] { ::operator delete(::operator new(64)); }) == 1);
    CHECK(counted([&] {
              ::operator delete (::operator new (64, std::align_val_t{64}), std::align_val_t{64});
          }) == 1);
    void* p = nullptr;
    CHECK(counted([&] { sum += posix_memalign(&p, 64, 64); }) == 1);
    std::free(p);
    CHECK(sum == 2);
}

#else

namespace forage::test {
inline constexpr bool counts_allocations = false;
}

TEST_CASE("Counting allocations") {
    WARN("allocations are not counted: a sanitizer brings its own, or the C library is not glibc");
}

#endif
