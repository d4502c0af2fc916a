// Which group fails first, where the order of work is not that of groups.
#pragma once

#include <algorithm>
#include <exception>
#include <limits>
#include <utility>
#include <vector>

namespace forage::engine {

/// Lets work on groups go on when some of it fails, by several threads at a time, and tells the failure of
/// the first group in the end: the one that one thread, in order, would have come to.
class FirstFailure {
  public:
    explicit FirstFailure(int threads = 1) : of_thread_(static_cast<std::size_t>(threads)) {}

    /// Calls work(). What it throws is kept.
    template <class Work>
    void guard(int group, int thread, Work work) {
        try {
            work();
        } catch (...) {
            auto& failure = of_thread_[static_cast<std::size_t>(thread)];
            if (group < failure.group) failure = {group, std::current_exception()};
        }
    }
    /// Whether any work has failed. To be called by one thread, like all that follows.
    bool any() const { return first()->reason != nullptr; }
    /// Whether work on a group before this one has failed.
    bool before(int group) const { return first()->group < group; }
    /// Throws what is kept, if anything is, and forgets it.
    void raise() {
        if (!any()) return;
        const auto reason = first()->reason;
        forget();
        std::rethrow_exception(reason);
    }
    void forget() { std::fill(of_thread_.begin(), of_thread_.end(), Failure{}); }

  private:
    struct Failure {
        int group = std::numeric_limits<int>::max();
        std::exception_ptr reason = nullptr;
    };

    std::vector<Failure>::const_iterator first() const {
        return std::min_element(of_thread_.begin(), of_thread_.end(),
                                [](const Failure& a, const Failure& b) { return a.group < b.group; });
    }

    std::vector<Failure> of_thread_;
};

}  // namespace forage::engine
