// Two runs side by side: the run that pages touch, and the course that it took before, or would take
// untouched.
#include <functional>

#include "core/base/archive.h"
#include "tools/studio/server/session.h"

namespace forage::studio {

void Session::swap_reference() {
    std::swap(run_, reference_->run);
    std::swap(touches_, reference_->touches);
    std::swap(history_, reference_->past);
    std::swap(changed_, reference_->changed);
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
    made.from = cycle, made.changed = changed_;
    Archive out;
    history_.save(out, cycle);
    Archive in{std::string_view(out.bytes())};
    made.past.load(in);
    run_beside(std::move(made), cycle);
}

void Session::run_beside(Reference made, std::uint64_t cycle) {
    end_reference();
    std::tie(made.run, made.touches) = make_run(begun_);
    reference_.emplace(std::move(made));
    with_reference([&] { replay(cycle); });
    status_due_ = true;
}

void Session::step_reference() {
    with_reference([this] {
        repeat_actions();
        run_->step();
        history_.after_cycle(*run_);
    });
}

void Session::end_reference() {
    if (!reference_) return;
    for (auto& [id, client] : clients_) client.end_reference();
    reference_.reset();
    status_due_ = true;
}

}  // namespace forage::studio
