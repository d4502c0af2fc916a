#include "tools/api/open/moves.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/run/argument_checks.h"

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

}  // namespace

void check_movable(Run& run, std::string_view name) {
    const auto& world = world_of(run);
    if (!world.find(name)) find_object(world, name);
}

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

void check_start(Run& run, std::string_view robot, std::optional<std::size_t> start) {
    find_robot(run, robot);
    const auto starts = world_of(run).start_poses().size();
    if (start && *start >= starts)
        throw InputError(fmt::format("there is no start pose {}: there are {}", *start, starts),
                         "they are counted from 0");
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

}  // namespace forage
