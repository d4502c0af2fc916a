#include "core/engine/parallel/thread_pool.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <pthread.h>

namespace forage::engine {
namespace {

constexpr int no_item = std::numeric_limits<int>::max();

/// The number of forks that led to this process.
unsigned forks = 0;

void count_forks() {
    [[maybe_unused]] static const int added = pthread_atfork(nullptr, nullptr, [] { ++forks; });
}

/// Leaves the processor to the thread beside it for a moment.
void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

/// Waits until `number` is not `value`: awake, as the next loop of a cycle usually comes within microseconds;
/// then letting others run, as the one that is waited for may be one of them, on the same processor; and
/// asleep after some 100 us, longer when others do run.
template <class T>
void wait_while(std::atomic<T>& number, T value) {
    constexpr int awake = 400, giving_way = 400;
    for (int looked = 0; number.load(std::memory_order_acquire) == value; ++looked)
        if (looked < awake)
            pause();
        else if (looked < awake + giving_way)
            std::this_thread::yield();
        else
            number.wait(value, std::memory_order_acquire);
}

}  // namespace

ThreadPool::ThreadPool(int threads) {
    const auto count = static_cast<std::size_t>(std::max(threads, 1));
    failures_.resize(count, {no_item, nullptr});
    shares_ = std::vector<Share>(count);
    count_forks();
    start();
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::start() {
    forks_ = forks, round_ = 0, stop_ = false;
    try {
        for (int t = 1; t < threads(); ++t) workers_.emplace_back([this, t] { serve(t); });
    } catch (...) {
        stop();
        throw;
    }
}

void ThreadPool::stop() {
    if (forks_ == forks) {
        stop_ = true;
        round_.fetch_add(1, std::memory_order_release);
        round_.notify_all();
        for (auto& w : workers_) w.join();
    } else {  // threads of another process can be neither joined nor destroyed
        static auto* const lost = new std::vector<std::thread>;
        std::ranges::move(workers_, std::back_inserter(*lost));
    }
    workers_.clear();
}

void ThreadPool::share() {
    if (forks_ != forks) stop(), start();
    busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    take_items(0);
    for (int n; (n = busy_.load(std::memory_order_acquire)) != 0;) wait_while(busy_, n);

    std::pair<int, std::exception_ptr> first{no_item, nullptr};
    for (auto& f : failures_) {
        if (f.first < first.first) first = f;
        f = {no_item, nullptr};
    }
    if (first.second) std::rethrow_exception(first.second);
}

void ThreadPool::serve(int thread) {
    for (std::uint32_t seen = 0;;) {
        wait_while(round_, seen);
        seen = round_.load(std::memory_order_acquire);
        if (stop_) return;
        take_items(thread);
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
    }
}

void ThreadPool::take_items(int thread) {
    for (std::size_t k = 0; k < shares_.size(); ++k) {
        Share& share = shares_[(static_cast<std::size_t>(thread) + k) % shares_.size()];
        for (int item; (item = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;) {
            try {
                call_(work_, item, thread);
            } catch (...) {
                auto& failure = failures_[static_cast<std::size_t>(thread)];
                if (item < failure.first) failure = {item, std::current_exception()};
            }
        }
    }
}

}  // namespace forage::engine
