// The loop does not allocate: replaces operator new for this program, and counts.
#include <cstdlib>
#include <new>

#include "tests/support/catch.h"
#include "tests/support/closed_loop.h"

namespace {
std::size_t allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    void* p = alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : std::malloc(size);
    if (!p) throw std::bad_alloc();
    return p;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, 1); }
void* operator new[](std::size_t size) { return counted(size, 1); }
void* operator new(std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace forage::test;

TEST_CASE("Cycles of system and world allocate nothing between two resets") {
    ClosedLoop loop({});
    for (int i = 0; i < 20; ++i) loop.step();
    const std::size_t before = allocations;
    for (int i = 0; i < 30; ++i) loop.step();
    const std::size_t after = allocations;
    REQUIRE(loop.world->trials(0).empty());
    CHECK(after - before == 0);
    CHECK(before > 0);  // it does count
}
