#include "tools/api/moves.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

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

void move(Run& run, std::string_view name, double x, double y, std::optional<double> heading) {
    auto& world = world_of(run);
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(heading.value_or(0)))
        throw InputError("a place has finite numbers", "x and y in m, the heading in rad");
    if (std::abs(x) > 1e4 || std::abs(y) > 1e4) throw InputError("a place is within 10 km");
    bool moved = false;
    if (const auto robot = world.find(name)) {
        moved = world.move_robot(*robot, {x, y, heading.value_or(world.pose(*robot).yaw)});
    } else {
        std::size_t i = 0;
        std::vector<std::string> names = world.robot_names();
        for (; i < world.movable_objects() && world.movable_object(i).name != name; ++i)
            names.push_back(world.movable_object(i).name);
        if (i == world.movable_objects())
            throw InputError(fmt::format("there is no robot and no movable object '{}'", name),
                             suggest(name, names));
        const Pose2 now = world.movable_object_pose(i).value_or(Pose2{});
        moved = world.move_object(i, {x, y, heading.value_or(now.yaw)});
    }
    if (!moved)
        throw InputError("something is there already",
                         "choose another place; a robot that is being reset cannot be moved");
}

void begin_trial(Run& run, std::string_view robot, std::optional<std::size_t> start) {
    auto& world = world_of(run);
    const auto number = find_robot(run, robot);
    const auto starts = world.start_poses();
    if (start && *start >= starts.size())
        throw InputError(fmt::format("there is no start pose {}: there are {}", *start, starts.size()),
                         "they are counted from 0");
    world.begin_trial(number, start ? std::optional(starts[*start]) : std::nullopt);
}

}  // namespace forage
