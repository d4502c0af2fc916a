// A run as Python sees it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tools/python/python.h"

namespace forage::python {

/// A film that grows while its run runs.
struct RunFilm {
    Observer* observer = nullptr;  ///< an observer of the run; null when the film is complete
    std::size_t frames = 0;        ///< their number, once the film is complete
};

/// A run, its callbacks, and the right to use it: one thread at a time runs cycles, while other threads of
/// Python continue. All functions are called with the GIL.
class PythonRun : public std::enable_shared_from_this<PythonRun> {
  public:
    /// What happens after the cycle in which a number became NaN or infinite for the first time.
    enum class OnNan { raise, warn, ignore };

    explicit PythonRun(std::shared_ptr<Run> run, OnNan on_nan = OnNan::warn);
    explicit PythonRun(Run run, OnNan on_nan = OnNan::warn)
        : PythonRun(std::make_shared<Run>(std::move(run)), on_nan) {}

    /// The run, to read and to change. Throws RunError when it is closed, or running in another thread.
    Run& use() const { return *owner(); }
    /// The same run, as an owner of the memory that a view shows.
    std::shared_ptr<Run> owner() const;
    OnNan on_nan() const { return on_nan_; }

    void step();
    /// Runs until `length` is reached, and returns whether its condition held. `progress` is called ten times
    /// per second with the fraction that is done and a text; it may be None. A trial that takes too long is
    /// ended if `truncate` is set, and throws RunError otherwise. Throws what a callback or a signal handler
    /// raises; the run can continue.
    bool advance(const RunLength& length, const py::object& progress, bool truncate);
    void on_cycle(py::object callback, std::uint64_t every);
    /// Removes the callback. Returns whether there was one.
    bool remove_callback(const py::object& callback);
    /// Forgets the run. Views of its numbers stay valid.
    void close();
    /// Adds a film, which close() completes.
    std::shared_ptr<RunFilm> add_film(Observer& film);
    /// Completes a film.
    void finish_film(RunFilm& film);
    bool closed() const { return !run_; }
    /// Why use() throws, in words; empty when it does not.
    std::string_view obstacle() const;

    /// The view of a state that always stands at the same place: what `make` returned at the first call.
    py::object view_of(int group, int state, const std::function<py::object()>& make);

    int traverse(visitproc visit, void* arg) const;  ///< for Python's search for cycles of references
    void clear() { callbacks_.clear(), views_.clear(); }

  private:
    class Running;
    struct Callback {
        py::object function;
        std::uint64_t every;
    };
    bool due() const;
    /// Warns before a long run that groups are computed which nothing needs.
    void check_demand(std::uint64_t cycles) const;
    /// Raises or warns, once, when a number is not finite.
    void check_finite();
    void call_back();

    std::shared_ptr<Run> run_;
    OnNan on_nan_;
    bool diverged_ = false;  ///< whether check_finite() has said so
    std::vector<Callback> callbacks_;
    std::map<std::pair<int, int>, py::object> views_;
    std::vector<std::shared_ptr<RunFilm>> films_;  ///< those that are not completed
    std::optional<std::thread::id> runner_;        ///< the thread that is running cycles
};

}  // namespace forage::python
