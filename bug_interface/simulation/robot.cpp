#include "bug_interface/simulation/robot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/surroundings.h"

namespace forage::bug {
namespace {

/// `outline`, given in the frame of a robot at `robot`, in the world.
Outline moved(const Outline& outline, const Pose2& robot) {
    const double c = std::cos(robot.yaw), s = std::sin(robot.yaw);
    Outline out = outline;
    out.x = robot.x + c * outline.x - s * outline.y;
    out.y = robot.y + s * outline.x + c * outline.y;
    out.cos_yaw = c * outline.cos_yaw - s * outline.sin_yaw;
    out.sin_yaw = s * outline.cos_yaw + c * outline.sin_yaw;
    return out;
}

}  // namespace

Pose in_space(const Pose2& pose) {
    Pose out = Pose::Identity();
    out.translation() = Eigen::Vector3d(pose.x, pose.y, 0);
    out.linear() = Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return out;
}

Robot::Robot(const Model& model, std::uint64_t seed_, Diagnostics& diagnostics)
    : name(model.name), seed(seed_), pose(in_plane(model.pose)) {
    const Link& link = *robot_link(model);
    link_pose = link.pose;
    range_sensors = link.range_sensors;
    if (!link.cameras.empty()) camera_sensor = link.cameras.front();
    motor_random = random(motor_noise);
    image_random = random(image_noise);

    const auto shape = std::find_if(link.collisions.begin(), link.collisions.end(),
                                    [](const Collision& c) { return c.shape.kind == ShapeKind::cylinder; });
    if (shape == link.collisions.end()) {
        diagnostics.error(link.where,
                          fmt::format("the body of robot '{}' has no cylinder as its collision shape", name),
                          "robots are upright cylinders here");
        return;
    }
    const Pose body_pose = link.pose * shape->pose;
    if (body_pose.translation().head<2>().norm() > 1e-6 || body_pose.linear()(2, 2) < 1 - 1e-6)
        diagnostics.error(
            shape->where,
            fmt::format("the body of robot '{}' does not stand upright on its model's origin", name));
    low = body_pose.translation().z() - shape->shape.size.z() / 2;
    high = body_pose.translation().z() + shape->shape.size.z() / 2;
    body = {shape->shape.size.x() / 2, link.mass, link.inertia_z, shape->friction};

    Model at_origin = model;
    at_origin.pose = Pose::Identity();
    each_link(at_origin, Pose::Identity(), [&](const Link& l, const Pose& p) {
        for (const Visual& v : l.visuals)
            if (v.shape.kind != ShapeKind::plane)
                visuals.push_back({p * v.pose,
                                   {{v.shape.kind, Pose::Identity(), v.shape.size}, v.material},
                                   l.name == "bug"});
    });
}

void Robot::surround(const WorldDescription& world, const std::vector<std::vector<Solid>>& robots,
                     std::size_t self) {
    const auto make = [&](std::string_view sensor, Stream use,
                          std::vector<double>& cells) -> std::optional<Scan> {
        const auto found = std::find_if(range_sensors.begin(), range_sensors.end(),
                                        [&](const RangeSensor& s) { return s.name == sensor; });
        if (found == range_sensors.end()) return {};
        Scan scan{RangeScanner(*found, link_pose),
                  random(use),
                  {},
                  {},
                  std::vector<double>(static_cast<std::size_t>(found->rays))};
        for (const Model& model : world.models) {
            if (robot_link(model)) continue;
            for (const Solid& solid : solids_of(model))
                if (const auto outline = cut(solid, scan.scanner.height())) scan.around.push_back(*outline);
        }
        for (std::size_t other = 0; other < robots.size(); ++other)
            for (const Solid& solid : robots[other])
                if (const auto outline = cut(solid, scan.scanner.height()); outline && other != self)
                    scan.moving.push_back({other, *outline});
        scan.around.resize(scan.around.size() + scan.moving.size());
        cells.assign(scan.ranges.size(), 0);
        return scan;
    };
    proximity = make("laser", proximity_noise, snapshot.proximity);
    target = make("laser_target", target_noise, snapshot.target);
    if (camera_sensor)
        snapshot.image_width = camera_sensor->width, snapshot.image_height = camera_sensor->height;
}

void Robot::Scan::run(const Pose2& body, std::uint64_t sample, bool with_noise, std::span<const Pose2> all,
                      std::span<double> cells) {
    auto at = around.end() - static_cast<std::ptrdiff_t>(moving.size());
    for (const Moving& m : moving) *at++ = moved(m.outline, all[m.robot]);
    scanner.scan(body, around, ranges);
    if (with_noise) scanner.add_noise(ranges, noise, sample);
    scanner.to_activity(ranges, cells);
}

void Robot::checkpoint(Archive& archive) {
    archive.same(name, "a robot");
    archive(pose, command);
    if (reset) archive(*reset);
    archive(*trials, snapshot, rendered);
}

void Robot::sense(bool with_noise, std::uint64_t sample, std::span<const Pose2> all) {
    snapshot.pose = pose;
    if (proximity) proximity->run(pose, sample, with_noise, all, snapshot.proximity);
    if (target) target->run(pose, sample, with_noise, all, snapshot.target);
}

void Robot::make_camera(std::shared_ptr<const Scene> scene) {
    if (!camera_sensor || camera) return;
    camera.emplace(*camera_sensor, link_pose, std::move(scene));
    const auto values =
        3 * static_cast<std::size_t>(camera->width()) * static_cast<std::size_t>(camera->height());
    picture_.resize(values);
    snapshot.image.resize(values);
}

void Robot::render(bool with_noise, std::uint64_t sample, std::span<const Pose2> all,
                   const std::vector<Robot>& robots) {
    if (!camera || rendered == sample) return;
    moving_.clear();
    for (std::size_t i = 0; i < robots.size(); ++i) {
        const Pose there = in_space(all[i]);
        for (const RobotVisual& v : robots[i].visuals) {
            if (&robots[i] == this && v.of_body) continue;
            moving_.push_back(v.visual);
            moving_.back().solid.pose = there * v.pose;
        }
    }
    camera->render(pose, moving_, picture_);
    if (with_noise) {
        camera->quantise(picture_, snapshot.image, image_random, sample);
    } else {
        for (std::size_t i = 0; i < picture_.size(); ++i)
            snapshot.image[i] = static_cast<std::uint8_t>(std::clamp(picture_[i], 0.0f, 1.0f) * 255 + 0.5f);
    }
    rendered = sample;
}

}  // namespace forage::bug
