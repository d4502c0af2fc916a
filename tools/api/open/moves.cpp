#include "tools/api/open/moves.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/model/world_change.h"
#include "core/run/argument_checks.h"
#include "core/run/input_error.h"

namespace forage {

bug::World& world_of(Run& run) {
    auto* world = dynamic_cast<bug::World*>(run.environment());
    if (!world) throw InputError("the system has no world", "open it with a world");
    return *world;
}

std::size_t find_robot(Run& run, std::string_view name) {
    const auto& world = world_of(run);
    const auto found = name.empty() && world.bugs() > 0 ? std::optional<std::size_t>(0) : world.find(name);
    if (!found)
        throw InputError(fmt::format("there is no robot '{}'", name), suggest(name, world.robot_names()));
    return *found;
}

namespace {

/// The number of the movable object with this name. Throws InputError when there is no robot with it, either.
std::size_t find_object(const bug::World& world, std::string_view name) {
    std::vector<std::string> names = world.robot_names();
    for (std::size_t i = 0; i < world.movable_objects(); ++i) {
        if (world.movable_object(i).name == name) return i;
        names.push_back(world.movable_object(i).name);
    }
    throw InputError(fmt::format("there is no robot and no movable object '{}'", name), suggest(name, names));
}

void check_start(Run& run, std::string_view robot, std::optional<std::size_t> start) {
    find_robot(run, robot);
    const auto starts = world_of(run).start_poses().size();
    if (start && *start >= starts)
        throw InputError(fmt::format("there is no start pose {}: there are {}", *start, starts),
                         "they are counted from 0");
}

using expression::Move;
using expression::NewTrial;

void check(Run& run, const Move& m) {
    const auto& world = world_of(run);
    if (!world.find(m.name.text)) find_object(world, m.name.text);
    check_pose(m.x, m.y, m.heading);
}
void check(Run& run, const NewTrial& t) { check_start(run, t.robot.text, t.start); }

void act(Run& run, const Move& m) { move(run, m.name.text, m.x, m.y, m.heading); }
void act(Run& run, const NewTrial& t) { begin_trial(run, t.robot.text, t.start); }

}  // namespace

void move(Run& run, std::string_view name, double x, double y, std::optional<double> heading) {
    check_pose(x, y, heading);
    auto& world = world_of(run);
    bool moved = false;
    if (const auto robot = world.find(name)) {
        moved = world.move_robot(*robot, {x, y, heading.value_or(world.pose(*robot).yaw)});
    } else {
        const auto object = find_object(world, name);
        const Pose2 now = world.movable_object_pose(object).value_or(Pose2{});
        moved = world.move_object(object, {x, y, heading.value_or(now.yaw)});
    }
    if (!moved)
        throw InputError("something is there already",
                         "choose another place; a robot that is being reset cannot be moved");
}

void begin_trial(Run& run, std::string_view robot, std::optional<std::size_t> start) {
    check_start(run, robot, start);
    auto& world = world_of(run);
    world.begin_trial(find_robot(run, robot),
                      start ? std::optional(world.start_poses()[*start]) : std::nullopt);
}

bool truncated(Run& run, const Trial& trial) {
    const auto& world = world_of(run);
    const auto plan = world.reset_plan();
    if (plan && !plan->bounds.contains(Eigen::Vector2d(trial.end.x, trial.end.y))) return false;
    return !(world.description().trials && trial.reached_target);
}

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
