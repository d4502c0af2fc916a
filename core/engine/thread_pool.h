// Threads that share the items of one loop at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace forage::engine {

/// Runs loops whose items do not depend on each other. The caller works too; with one thread there is nothing
/// else.
class ThreadPool {
  public:
    /// Throws std::system_error when the threads cannot be started.
    explicit ThreadPool(int threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int threads() const { return static_cast<int>(workers_.size()) + 1; }

    /// Calls work(item, thread) for each item from 0 to `items` - 1, on any thread (0: the caller's), and
    /// waits for all. Allocates nothing. When several items throw, the exception of the lowest one is thrown
    /// again. Unless it is `worth` to share the loop, the caller does all.
    template <class Work>
    void run(int items, Work& work, bool worth = true) {
        if (workers_.empty() || items < 2 || !worth) {
            for (int i = 0; i < items; ++i) work(i, 0);
            return;
        }
        call_ = [](void* w, int item, int thread) { (*static_cast<Work*>(w))(item, thread); };
        work_ = &work;
        share(items);
    }

  private:
    void stop();
    void share(int items);
    void serve(int thread);
    void take_items(int thread);

    std::vector<std::thread> workers_;
    void (*call_)(void*, int, int) = nullptr;
    void* work_ = nullptr;
    int items_ = 0;
    std::atomic<int> next_{0}, busy_{0};
    std::atomic<std::uint32_t> round_{0};
    std::atomic<bool> stop_{false};
    std::vector<std::pair<int, std::exception_ptr>> failures_;  ///< one per thread: item and exception
};

}  // namespace forage::engine
