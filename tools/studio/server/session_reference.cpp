// Two runs side by side: the run that pages touch, and the course that it took before, or would take
// untouched.
#include <functional>
#include <memory>
#include <utility>

#include "core/base/archive.h"
#include "tools/studio/server/session.h"

namespace forage::studio {

void Session::swap_reference() {
    std::swap(live.run, live.reference->run);
    std::swap(live.touches, live.reference->touches);
    std::swap(live.history, live.reference->past);
    std::swap(live.changed, live.reference->changed);
}

void Session::with_reference(const std::function<void()>& act) {
    swap_reference();
    try {
        act();
    } catch (...) {
        swap_reference();
        end_reference();
        throw;
    }
    swap_reference();
}

namespace {

/// A second run with the past of the run, still without its Run.
Reference past_of(LiveRun& live, std::uint64_t cycle) {
    Reference out;
    out.from = cycle, out.changed = live.changed;
    Archive saved;
    live.history.save(saved, cycle);
    Archive in{std::string_view(saved.bytes())};
    out.past.load(in);
    return out;
}

}  // namespace

void Session::begin_reference(std::uint64_t cycle) { run_beside(past_of(live, cycle), cycle); }

void Session::with_copy(std::uint64_t cycle, const std::function<void()>& act) {
    Reference copy = past_of(live, cycle);
    std::tie(copy.run, copy.touches) = make_run(live.begun);
    auto comparison = std::exchange(live.reference, std::move(copy));
    swap_reference();
    const auto end = [&](Session* session) {
        session->swap_reference();
        session->live.reference = std::move(comparison);
    };
    const std::unique_ptr<Session, decltype(end)> ended(this, end);
    live.history.restore(*live.run, cycle);
    act();
}

void Session::run_beside(Reference made, std::uint64_t cycle) {
    std::tie(made.run, made.touches) = make_run(live.begun);
    end_reference();
    live.reference.emplace(std::move(made));
    with_reference([&] { replay(cycle); });
    pages.status_due = true;
}

void Session::step_reference() {
    with_reference([this] {
        repeat_actions();
        live.run->step();
        live.history.after_cycle(*live.run);
    });
}

void Session::end_reference() {
    if (!live.reference) return;
    for (auto& [id, client] : pages.clients) client.end_reference();
    live.reference.reset();
    pages.status_due = true;
}

}  // namespace forage::studio
