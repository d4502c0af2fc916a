// The foraging arena of the project, for tests of what the robot senses in it.
#pragma once

#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/range_scan.h"
#include "bug_interface/world/sdf_reader.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

namespace forage::bug::test {

inline constexpr double up = std::numbers::pi / 2;  ///< the yaw of a robot that looks along +y

/// Reads a world of the project, or fails the test.
inline WorldDescription world_of_project(const std::string& name) {
    Diagnostics diagnostics;
    const auto path = forage::test::source_dir() / "systems" / "worlds" / name;
    auto world = read_world(path.string(), diagnostics);
    INFO(format(diagnostics));
    REQUIRE(world);
    return *world;
}

/// basic_arena.world and its robot.
struct Arena {
    static const Arena& get() {  ///< read once
        static const Arena arena;
        return arena;
    }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    WorldDescription world = world_of_project("basic_arena.world");
    const Link& link = robot().links.at(0);
    std::vector<std::string> excluded = {"Bug"};
    std::shared_ptr<const Scene> scene = std::make_shared<Scene>(world, excluded);

    const Model& robot() const {
        for (const Model& model : world.models)
            if (model.name == "Bug") return model;
        throw std::runtime_error("no Bug in the world");
    }
    const RangeSensor& range_sensor(const std::string& name) const {
        for (const RangeSensor& sensor : link.range_sensors)
            if (sensor.name == name) return sensor;
        throw std::runtime_error("no sensor " + name);
    }
    RangeScanner scanner(const std::string& name) const { return {range_sensor(name), link.pose}; }
    Camera camera(int samples_per_axis = 2) const {
        return {link.cameras.at(0), link.pose, scene, samples_per_axis};
    }

    /// All collision solids but the robot's.
    std::vector<Solid> solids() const {
        std::vector<Solid> out;
        for (const Model& model : world.models)
            for (const Link& l : model.links)
                for (const Collision& c : l.collisions)
                    if (model.name != "Bug" && c.shape.kind != ShapeKind::plane)
                        out.push_back({c.shape.kind, model.pose * l.pose * c.pose, c.shape.size});
        return out;
    }

  private:
    Arena() = default;
};

/// What `scanner` measures among `solids`, as cells of a group; no noise.
inline std::vector<double> cells_of(const RangeScanner& scanner, const std::vector<Solid>& solids,
                                    const Pose2& body) {
    std::vector<Outline> outlines;
    for (const Solid& solid : solids)
        if (const auto outline = cross_section(solid, scanner.height())) outlines.push_back(*outline);
    std::vector<double> ranges(static_cast<std::size_t>(scanner.rays())), cells(ranges.size());
    scanner.scan(body, outlines, ranges);
    scanner.to_activity(ranges, cells);
    return cells;
}

inline std::vector<float> picture(Camera camera, const Pose2& body,
                                  std::span<const VisualSolid> moving = {}) {
    std::vector<float> rgb(3 * static_cast<std::size_t>(camera.width() * camera.height()));
    std::vector<const VisualSolid*> solids;
    for (const VisualSolid& solid : moving) solids.push_back(&solid);
    camera.render(body, solids, rgb);
    return rgb;
}

inline Pose at(double x, double y, double z, double yaw = 0) {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(x, y, z);
    pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return pose;
}

}  // namespace forage::bug::test
