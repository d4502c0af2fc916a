#include "tools/python/run.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/run/stop_condition.h"
#include "tools/api/open/moves.h"
#include "tools/python/held.h"

namespace forage::python {
namespace {

using Clock = std::chrono::steady_clock;

/// Intervals at which signals such as that of Ctrl-C are looked for, and progress is shown.
constexpr auto between_signals = std::chrono::milliseconds(20);
constexpr auto between_reports = std::chrono::milliseconds(100);

/// The fewest cycles of a run that is worth a warning about what it computes.
constexpr std::uint64_t long_run = 10'000;

/// Whether this is the thread in which Python handles signals.
bool in_main_thread() {
    const auto threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

/// While it lives, Ctrl-C waits until a cycle has ended, because an update of a Python type that is
/// interrupted would leave a run that cannot continue. A second Ctrl-C does not wait, for an update that does
/// not end. Does nothing without Python types, and outside the main thread, in which Python handles signals.
class LateInterrupt {
  public:
    LateInterrupt() {
        if (!has_python_types() || !in_main_thread()) return;
        signal_ = py::module_::import("signal");
        usual_ = signal_.attr("getsignal")(signal_.attr("SIGINT"));
        if (!PyCallable_Check(usual_.ptr())) return;
        const auto flag = waiting_;
        signal_.attr("signal")(signal_.attr("SIGINT"),
                               py::cpp_function([flag, usual = usual_](int number, const py::object& frame) {
                                   if (std::exchange(*flag, true)) usual(number, frame);
                               }));
        replaced_ = true;
    }
    ~LateInterrupt() {
        if (!replaced_) return;
        try {
            signal_.attr("signal")(signal_.attr("SIGINT"), usual_);
        } catch (py::error_already_set& e) {
            e.discard_as_unraisable("the end of a run");
        }
    }
    LateInterrupt(const LateInterrupt&) = delete;
    LateInterrupt& operator=(const LateInterrupt&) = delete;

    bool waiting() const { return *waiting_; }
    /// Carries out an interrupt that waits.
    void deliver() {
        if (std::exchange(*waiting_, false)) usual_(signal_.attr("SIGINT"), py::none());
    }

  private:
    const std::shared_ptr<bool> waiting_ = std::make_shared<bool>(false);
    py::object signal_, usual_;
    bool replaced_ = false;
};

}  // namespace

/// Marks a run as running in this thread.
class PythonRun::Running {
  public:
    explicit Running(PythonRun& run) : run_(run) {
        run.use();
        if (run.runner_)
            throw engine::RunError(
                "this run is running: a callback may read and change it, but not run cycles");
        run.runner_ = std::this_thread::get_id();
    }
    ~Running() { run_.runner_.reset(); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

  private:
    PythonRun& run_;
};

PythonRun::PythonRun(std::shared_ptr<Run> run, OnNan on_nan) : run_(std::move(run)), on_nan_(on_nan) {
    run_->start();
    diverged_ = !run_->divergence().empty();
}

std::shared_ptr<Run> PythonRun::owner() const {
    if (const auto why = obstacle(); !why.empty()) throw engine::RunError("this run is " + std::string(why));
    return run_;
}

std::string_view PythonRun::obstacle() const {
    if (!run_) return "closed";
    return runner_ && *runner_ != std::this_thread::get_id() ? "running in another thread" : "";
}

void PythonRun::close() {
    if (runner_) throw engine::RunError("this run is running: it cannot be closed");
    while (!films_.empty()) finish_film(*std::shared_ptr(films_.back()));
    clear();
    run_.reset();
}

std::shared_ptr<RunFilm> PythonRun::add_film(Observer& film) {
    return films_.emplace_back(std::make_shared<RunFilm>(RunFilm{&film}));
}

void PythonRun::finish_film(RunFilm& film) {
    Run& run = use();
    std::erase_if(films_, [&](const auto& other) { return other.get() == &film; });
    film.frames = forage::finish_film(run, *film.observer);
    film.observer = nullptr;
}

void PythonRun::on_cycle(py::object callback, std::uint64_t every) {
    use();
    if (every == 0) throw InputError("every is 0", "1 calls back after every cycle");
    callbacks_.push_back({std::move(callback), every});
}

bool PythonRun::remove_callback(const py::object& callback) {
    use();
    return std::erase_if(callbacks_, [&](const Callback& c) { return c.function.equal(callback); }) > 0;
}

bool PythonRun::due() const {
    const auto cycle = run_->cycle();
    return std::ranges::any_of(callbacks_, [&](const Callback& c) { return cycle % c.every == 0; });
}

void PythonRun::call_back() {
    const auto self = py::cast(shared_from_this());
    std::vector<py::object> functions;  // a callback may add and remove callbacks
    for (const auto& c : callbacks_)
        if (run_->cycle() % c.every == 0) functions.push_back(c.function);
    for (const auto& function : functions) function(self);
}

void PythonRun::step() {
    const Running running(*this);
    LateInterrupt interrupt;
    {
        const py::gil_scoped_release others;
        run_->step();
    }
    if (due()) call_back();
    interrupt.deliver();
    check_finite();
}

void PythonRun::check_demand(std::uint64_t cycles) const {
    if (cycles < long_run) return;
    std::vector<int> shown;
    for (const auto& [column, view] : views_) shown.push_back(column.first);
    const std::size_t count = run_->prunable_groups(shown);
    if (count == 0) return;
    Diagnostics warnings;
    warnings.warning(
        {},
        fmt::format("{} of {} groups are computed only because they may be read later", count,
                    run_->layout().groups.size()),
        "with the sources that you read, forage.open(..., observe=[...]) is faster, and gives the same "
        "numbers");
    warn(warnings);
}

void PythonRun::check_finite() {
    if (diverged_ || run_->divergence().empty()) return;
    diverged_ = true;
    if (on_nan_ == OnNan::raise) throw engine::RunError(run_->divergence());
    if (on_nan_ == OnNan::warn && PyErr_WarnEx(PyExc_RuntimeWarning, run_->divergence().c_str(), 1) != 0)
        throw py::error_already_set();
}

bool PythonRun::advance(const RunLength& length, const py::object& progress, bool truncate) {
    const Running running(*this);
    LateInterrupt interrupt;
    const bool signals = in_main_thread(), shown = !progress.is_none();
    auto next_signals = Clock::now() + between_signals, next_report = Clock::now();
    Diagnostics mistakes;
    RunLength whole = length;  // `left` is shorter after a trial that was truncated
    whole.in_code = true;
    const auto stop = checked(mistakes, StopCondition::make(whole, *run_, mistakes));
    check_demand(stop.cycles().value_or(0));
    const auto origin = StopCondition::begin(*run_);
    const auto after_cycle = [&](const StopCondition&, const StopOrigin&) {
        if (due()) {
            const py::gil_scoped_acquire python;
            call_back();
        }
        if (on_nan_ == OnNan::raise && !diverged_) check_finite();
        if (!signals && !shown) return;
        const auto now = Clock::now();
        if (signals && (now >= next_signals || interrupt.waiting())) {
            next_signals = now + between_signals;
            const py::gil_scoped_acquire python;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            interrupt.deliver();
        }
        if (shown && now >= next_report) {
            next_report = now + between_reports;
            const py::gil_scoped_acquire python;
            progress(stop.fraction_done(*run_, origin), stop.progress(*run_));
        }
    };
    EarlyEnd end;
    RunLength left = length;
    while (true) {
        const std::size_t before = run_->has_trials() ? run_->environment()->trials(0).size() : 0;
        {
            const py::gil_scoped_release others;
            end = run_->advance(left, after_cycle);
        }
        if (end.timeout.empty() || !truncate) break;
        begin_trial(*run_);
        end.timeout.clear();
        const std::size_t ended = run_->environment()->trials(0).size() - before;
        if (ended >= *left.trials) {
            end.held = stop.holds(*run_);
            break;
        }
        *left.trials -= ended;
    }
    interrupt.deliver();
    if (shown) progress(1.0, "");
    check_finite();
    if (!end.timeout.empty()) throw engine::RunError(end.timeout);
    return end.held;
}

py::object PythonRun::view_of(int group, int state, const std::function<py::object()>& make) {
    auto& view = views_[{group, state}];
    if (!view) view = make();
    return view;
}

int PythonRun::traverse(visitproc visit, void* arg) const {
    for (const auto& c : callbacks_) Py_VISIT(c.function.ptr());
    return 0;
}

}  // namespace forage::python
