#include "tools/studio/server/stream_source.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "bug_interface/simulation/world.h"
#include "core/observe/source.h"
#include "tools/studio/server/sampled_synapses.h"

namespace forage::studio {
namespace {

constexpr std::size_t max_cells = 1'000'000;    ///< of a stream
constexpr std::size_t max_append_cells = 4096;  ///< of a stream of every cycle

const bug::World& world_in(Run& run) { return static_cast<const bug::World&>(*run.environment()); }

/// Writes a row; `out` becomes what follows it.
void put_row(std::span<double>& out, std::initializer_list<double> row) {
    std::ranges::copy(row, out.begin());
    out = out.subspan(row.size());
}

StreamSource cell_source(observe::Source source) {
    const auto& range = source.what().cells;
    StreamSource out{1, 1, source.what().label};
    if (!source.what().one_number())
        out.rows = static_cast<std::uint32_t>(range.height),
        out.columns = static_cast<std::uint32_t>(range.width);
    source.declare(out.demand);
    out.read = [source = std::move(source)](Run& run, std::span<double> numbers) {
        source.read(run.simulation(), numbers);
    };
    return out;
}

StreamSource pose_source(const bug::World& described) {
    const std::size_t bodies = described.bugs() + described.movable_objects();
    const auto read = [bodies](Run& run, std::span<double> out) {
        const auto& world = world_in(run);
        for (std::size_t i = 0; i < bodies; ++i) {
            const auto object = i < world.bugs() ? std::nullopt : world.movable_object_pose(i - world.bugs());
            const Pose2 pose = i < world.bugs() ? world.pose(i) : object.value_or(Pose2{});
            const double state = i < world.bugs() ? (world.resetting(i) ? 2 : 1) : object ? 1 : 0;
            put_row(out, {pose.x, pose.y, 0, pose.yaw, state});
        }
    };
    return {static_cast<std::uint32_t>(bodies), 5, "x, y, z, yaw, presence", read};
}

bool is_shown(const bug::RangeSensor& s) { return s.name == "laser" || s.name == "laser_target"; }

StreamSource ray_source(const bug::World& described, std::size_t robot) {
    const auto read = [robot](Run& run, std::span<double> out) {
        const auto& world = world_in(run);
        const auto& sensors = world.robot(robot).sensors;
        const Pose2 pose = world.pose(robot);
        for (const auto& s : sensors.range_sensors()) {
            if (!is_shown(s)) continue;
            const bool light = s.name == "laser_target";
            const auto& cells = light ? sensors.snapshot().target : sensors.snapshot().proximity;
            for (int k = 0; k < s.rays; ++k) {
                const double activity =
                    static_cast<std::size_t>(k) < cells.size() ? cells[static_cast<std::size_t>(k)] : 0;
                const double angle = pose.yaw + s.cell_angle(k), c = std::cos(angle), d = std::sin(angle);
                const double range = s.max_range * (1 - activity);
                put_row(out, {pose.x + s.min_range * c, pose.y + s.min_range * d, pose.x + range * c,
                              pose.y + range * d, light ? 1. : 0., activity});
            }
        }
    };
    std::uint32_t rows = 0;
    for (const auto& s : described.robot(robot).sensors.range_sensors())
        if (is_shown(s)) rows += static_cast<std::uint32_t>(s.rays);
    return {rows, 6, "x, y, to x, to y, kind, activity", read};
}

/// What a robot consists of, with the gripper as it is now.
StreamSource part_source(const bug::World& described, std::size_t robot) {
    const auto read = [robot](Run& run, std::span<double> out) {
        const auto& world = world_in(run);
        for (const auto& v : world.moving_visuals()) {
            if (v.body != robot) continue;
            const auto pose = v.at(world.body_poses());
            const Eigen::Vector3d p = pose.translation(), size = v.visual.solid.size;
            const auto& colour = v.visual.material.diffuse;
            const auto kind = static_cast<double>(v.visual.solid.kind);
            put_row(out, {kind, p.x(), p.y(), p.z(), bug::yaw_of(pose), size.x(), size.y(), size.z(),
                          colour[0], colour[1], colour[2]});
        }
    };
    std::uint32_t rows = 0;
    for (const auto& v : described.moving_visuals()) rows += v.body == robot;
    return {rows, 11, "kind, x, y, z, yaw, size, red, green, blue", read};
}

StreamSource camera_source(const bug::CameraSensor& camera, std::size_t robot) {
    const auto read = [robot](Run& run, std::span<double> out) {
        const auto image = static_cast<bug::World&>(*run.environment()).image(robot);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = i < image.size() ? image[i] : 0;
    };
    return {static_cast<std::uint32_t>(camera.height), static_cast<std::uint32_t>(3 * camera.width),
            "red, green, blue", read, Type::uint8};
}

StreamSource trail_source(std::size_t robot) {
    const auto read = [robot](Run& run, std::span<double> out) {
        const auto& world = *run.environment();
        const Pose2 pose = world.pose(robot);
        put_row(out, {pose.x, pose.y,
                      world.has_trials(robot) ? static_cast<double>(world.current_trial(robot).number) : 0.});
    };
    return {1, 3, "x, y, trial", read};
}

StreamSource world_source(Run& run, std::string_view text) {
    const auto* world = dynamic_cast<const bug::World*>(run.environment());
    if (!world) throw InputError(fmt::format("'{}' needs a world", text), "open the system with --world");
    if (text == "world:poses") return pose_source(*world);
    const auto colon = text.find(':', 6);
    const std::string_view kind = text.substr(0, colon);
    std::optional<std::size_t> robot =
        world->bugs() > 0 && colon == text.npos ? std::optional<std::size_t>(0) : std::nullopt;
    if (colon != text.npos) robot = world->find(text.substr(colon + 1));
    if (!robot)
        throw InputError(fmt::format("'{}' names no robot of this world", text),
                         suggest(colon == text.npos ? "" : text.substr(colon + 1), world->robot_names()));
    if (kind == "world:rays") return ray_source(*world, *robot);
    if (kind == "world:parts") return part_source(*world, *robot);
    if (kind == "world:trail") return trail_source(*robot);
    if (kind == "world:camera") {
        if (const auto& camera = world->robot(*robot).sensors.camera_sensor())
            return camera_source(*camera, *robot);
        throw InputError(fmt::format("the robot of '{}' has no camera", text));
    }
    throw InputError(
        fmt::format("'{}' is not a stream of a world", text),
        "world:poses, world:rays:ROBOT, world:parts:ROBOT, world:camera:ROBOT or world:trail:ROBOT");
}

}  // namespace

StreamSource find_stream_source(Run& run, std::string_view text, Delivery delivery) {
    const auto find = [&]() -> StreamSource {
        if (text.starts_with("world:")) return world_source(run, text);
        if (text.starts_with("sampled(") && text.ends_with(')'))
            return sampled_synapses(run, text.substr(8, text.size() - 9));
        Diagnostics diagnostics;
        auto source =
            checked(diagnostics, observe::find_source(run.layout(), text, "subscribe", diagnostics));
        return cell_source(std::move(*source));
    };
    auto out = find();
    run.require(out.demand, fmt::format("'{}'", text));
    const std::size_t numbers = std::size_t{out.rows} * out.columns;
    const std::size_t max = delivery == Delivery::append ? max_append_cells : max_cells;
    if (numbers > max)
        throw InputError(fmt::format("'{}' has {} numbers; a stream has at most {}", text, numbers, max),
                         "name a part of the cells, such as (1..30,1..30), or the mean");
    return out;
}

}  // namespace forage::studio
