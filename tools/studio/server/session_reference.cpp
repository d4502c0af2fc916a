// Two runs side by side: the run that pages touch, and the course that it took before, or would take
// untouched.
#include <exception>
#include <utility>

#include "tools/studio/server/session.h"

namespace forage::studio {

void Session::begin_reference(std::uint64_t cycle) { run_beside({live.past(cycle), cycle}, cycle); }

Course Session::copy_at(std::uint64_t cycle) {
    Course out = live.past(cycle);
    out.take_run(open_run(live.begun));
    out.history.restore(*out.run, cycle);
    return out;
}

void Session::run_beside(Reference reference, std::uint64_t cycle) {
    reference.take_run(open_run(live.begun));
    reference.replay(cycle);
    end_reference();
    live.reference = std::move(reference);
    ++live.version, pages.status_due = true;  // it is kept, too
}

void Session::compute_beside(const std::function<void(Course&)>& cycles) {
    if (!live.reference) return;
    try {
        cycles(*live.reference);
    } catch (const std::exception& e) {
        end_reference();
        log({.command = "compare_end", .title = "end of the comparison", .failed = e.what()});
    }
}

void Session::end_reference() {
    if (!live.reference) return;
    for (auto& [id, client] : pages.clients) client.end_reference();
    live.reference.reset();
    ++live.version, pages.status_due = true;
}

}  // namespace forage::studio
