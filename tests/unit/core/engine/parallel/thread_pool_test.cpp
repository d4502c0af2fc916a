#include "core/engine/parallel/thread_pool.h"

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/catch.h"
#include "tests/support/limited_memory.h"

using forage::engine::ThreadPool;

TEST_CASE("Every item is processed once, with any number of threads") {
    ThreadPool pool(GENERATE(1, 2, 4));
    for (const int items : {0, 1, 2, 3, 1000}) {
        std::vector<std::atomic<int>> done(static_cast<std::size_t>(items));
        std::atomic<int> wrong_numbers{0};  // Catch2 itself is for one thread
        auto work = [&](int item, int thread) {
            if (thread < 0 || thread >= pool.threads()) ++wrong_numbers;
            ++done[static_cast<std::size_t>(item)];
        };
        for (int round = 0; round < 20; ++round) pool.run(items, work);
        REQUIRE(wrong_numbers == 0);
        for (const auto& n : done) REQUIRE(n == 20);
    }
}

TEST_CASE("Shares of items of any size are all processed, whichever thread takes them") {
    ThreadPool pool(GENERATE(1, 2, 4));
    std::vector<int> shares{0};
    for (int t = 0; t < pool.threads(); ++t) shares.push_back(shares.back() + (t == 1 ? 0 : 7 * t + 1));
    std::vector<std::atomic<int>> done(static_cast<std::size_t>(shares.back()));
    auto work = [&](int item, int) { ++done[static_cast<std::size_t>(item)]; };
    for (int round = 0; round < 50; ++round) pool.run(shares, work);
    for (const auto& n : done) REQUIRE(n == 50);
    auto failing = [&](int item, int) {
        if (item >= shares.back() - 1) throw std::runtime_error("the last");
    };
    CHECK_THROWS_WITH(pool.run(shares, failing), "the last");
    pool.run(shares, work);
    for (const auto& n : done) REQUIRE(n == 51);
}

TEST_CASE("The exception of the lowest item that fails is thrown, and the pool can still be used") {
    ThreadPool pool(GENERATE(1, 4));
    auto work = [](int item, int) {
        if (item == 7 || item == 90) throw std::runtime_error(std::to_string(item));
    };
    for (int round = 0; round < 20; ++round) CHECK_THROWS_WITH(pool.run(100, work), "7");
    auto fine = [](int, int) {};
    pool.run(100, fine);
}

TEST_CASE("The child of a fork has threads of its own, and may leave the pool unused", "[without-tsan]") {
    ThreadPool pool(3), other(2);
    std::array<std::atomic<int>, 100> done{};
    auto work = [&](int item, int) { ++done[static_cast<std::size_t>(item)]; };
    pool.run(100, work);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        alarm(60);  // ends a child that hangs
        for (int round = 0; round < 20; ++round) pool.run(100, work);
        const pid_t grandchild = fork();
        pool.run(100, work);
        const bool fine = std::ranges::all_of(done, [](const auto& n) { return n == 22; });
        { const ThreadPool gone = ThreadPool(2); }
        std::destroy_at(&other), std::construct_at(&other, 2);
        int status = 0;
        if (grandchild != 0) waitpid(grandchild, &status, 0);
        _exit(fine && status == 0 ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    CHECK(status == 0);
    pool.run(100, work);
    for (const auto& n : done) REQUIRE(n == 2);
}

TEST_CASE("When a thread cannot be started, the running threads are ended and the error is thrown") {
    if (!forage::test::can_limit_memory) {
        WARN("not tested: a sanitizer needs all memory");
        return;
    }
    const forage::test::LimitedMemory limit(std::size_t{48} << 20);  // room for few stacks
    CHECK_THROWS_AS(ThreadPool(64), std::system_error);
}
