#include "tools/api/open/world_actions.h"

#include <stdexcept>

#include <fmt/format.h>

#include "core/model/world_change.h"
#include "core/run/argument_checks.h"
#include "core/run/input_error.h"
#include "tools/api/open/moves.h"

namespace forage {
namespace {

using expression::Move;
using expression::NewTrial;

void check(Run& run, const Move& m) {
    check_movable(run, m.name.text);
    check_pose(m.x, m.y, m.heading);
}
void check(Run& run, const NewTrial& t) { check_start(run, t.robot.text, t.start); }

void act(Run& run, const Move& m) { move(run, m.name.text, m.x, m.y, m.heading); }
void act(Run& run, const NewTrial& t) { begin_trial(run, t.robot.text, t.start); }

}  // namespace

observe::ReadAction actions_on(Run& run) {
    return [&run](const model::Expression& change, std::string_view what,
                  Diagnostics& diagnostics) -> std::optional<observe::Schedule::Action> {
        if (change.at.file) return std::nullopt;  // an experiment changes parameters only
        const expression::Context context{change.text, what, diagnostics, change.at};
        const auto read = context.parsed(expression::parse_world_change);
        if (!read) return observe::Schedule::Action();
        if (!*read) return std::nullopt;
        try {
            std::visit([&](const auto& c) { check(run, c); }, **read);
        } catch (const InputError& e) {
            for (const auto& d : e.diagnostics().all()) context.error(0, d.message, d.hint);
            return observe::Schedule::Action();
        }
        return [to = **read, text = change.text](RunView& view) {
            try {
                std::visit([&](const auto& c) { act(view.run, c); }, to);
            } catch (const InputError& e) {  // the world does not allow it at this time
                const auto& found = e.diagnostics().all().front();
                throw std::runtime_error(fmt::format("'{}' in cycle {}: {}; {}", text, view.time.cycle,
                                                     found.message, found.hint));
            }
        };
    };
}

}  // namespace forage
