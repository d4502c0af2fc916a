// Two runs side by side: the run that pages touch, and the course that it took before, or would take
// untouched.
#include <functional>

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

void Session::begin_reference(std::uint64_t cycle) {
    Reference made;
    made.from = cycle, made.changed = live.changed;
    Archive out;
    live.history.save(out, cycle);
    Archive in{std::string_view(out.bytes())};
    made.past.load(in);
    run_beside(std::move(made), cycle);
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
