// Threads that share the items of one loop at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace forage::engine {

/// Runs loops whose items do not depend on each other. The calling thread works, too. In the child of a
/// fork(), which has none of the other threads, the next loop starts them again.
class ThreadPool {
  public:
    /// Starts the other threads. Throws std::system_error when that fails.
    explicit ThreadPool(int threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int threads() const { return static_cast<int>(shares_.size()); }

    /// Calls work(item, thread) for each item from 0 to `items` - 1, on any thread (0: the caller's), and
    /// waits for all. Allocates nothing. When several items throw, the exception of the lowest one is thrown
    /// again.
    template <class Work>
    void run(int items, Work& work) {
        if (workers_.empty() || items < 2) {
            for (int i = 0; i < items; ++i) work(i, 0);
            return;
        }
        const int n = threads();
        for (int t = 0; t < n; ++t) own(t, items * t / n, items * (t + 1) / n);
        share(work);
    }
    /// Calls work(item, thread) in the same way, but thread t takes items `shares`[t] to `shares`[t + 1] - 1
    /// first, and those of other threads only when it has finished its own. So a thread finds in its cache
    /// what it left there in the loop before.
    template <class Work>
    void run(std::span<const int> shares, Work& work) {
        for (int t = 0; t < threads(); ++t)
            own(t, shares[static_cast<std::size_t>(t)], shares[static_cast<std::size_t>(t) + 1]);
        share(work);
    }

  private:
    /// The items that one thread takes first. Each share has a cache line of its own.
    struct alignas(64) Share {
        std::atomic<int> next{0};
        int end = 0;
    };

    void own(int thread, int first, int end) {
        Share& share = shares_[static_cast<std::size_t>(thread)];
        share.next.store(first, std::memory_order_relaxed);
        share.end = end;
    }
    template <class Work>
    void share(Work& work) {
        call_ = [](void* w, int item, int thread) { (*static_cast<Work*>(w))(item, thread); };
        work_ = &work;
        share();
    }
    void share();
    void start();
    void stop();
    void serve(int thread);
    void take_items(int thread);

    std::vector<std::thread> workers_;
    unsigned forks_ = 0;  ///< the number of forks when they were started
    void (*call_)(void*, int, int) = nullptr;
    void* work_ = nullptr;
    std::vector<Share> shares_;  ///< one per thread
    alignas(64) std::atomic<std::uint32_t> round_{0};
    alignas(64) std::atomic<int> busy_{0};
    std::atomic<bool> stop_{false};
    std::vector<std::pair<int, std::exception_ptr>> failures_;  ///< one per thread: item and exception
};

}  // namespace forage::engine
