#include "bug_interface/simulation/robot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/simulation/surroundings.h"

namespace forage::bug {

Pose in_space(const Pose2& pose) {
    Pose out = Pose::Identity();
    out.translation() = Eigen::Vector3d(pose.x, pose.y, 0);
    out.linear() = Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return out;
}

Robot::Robot(const Model& model, std::size_t number_, std::uint64_t seed_, Heights& heights,
             Diagnostics& diagnostics)
    : name(model.name), number(number_), seed(seed_), pose(in_plane(model.pose)) {
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
    const auto layer_of = [&](const Solid& solid, const Location& where) {
        const double middle = solid.pose.translation().z(), half = solid.size.z() / 2;
        return heights.layer(middle - half, middle + half, where, diagnostics);
    };
    const Solid body_solid{ShapeKind::cylinder, body_pose, shape->shape.size};
    body.radius = shape->shape.size.x() / 2, body.mass = link.mass, body.inertia = link.inertia_z;
    body.friction = shape->friction, body.layer = layer_of(body_solid, shape->where);

    for (const bug::Limb& limb : limbs_of(model, hinges)) {
        for (const Collision& c : limb.link->collisions) {
            if (c.shape.kind == ShapeKind::plane) continue;
            const Solid solid{c.shape.kind, limb.home * c.pose, c.shape.size};
            const bool of_body = &c == &*shape;
            solids.push_back({number, limb.hinge, solid, of_body});
            if (of_body) continue;
            const auto outline = cut(solid, solid.pose.translation().z());
            const int layer = layer_of(solid, c.where);
            if (!outline) continue;
            limbs.push_back({*outline, limb.hinge});
            body.parts.push_back({*outline, layer, c.friction});
        }
        for (const Visual& v : limb.link->visuals)
            if (v.shape.kind != ShapeKind::plane)
                visuals.push_back({number,
                                  limb.hinge,
                                  limb.home * v.pose,
                                  {{v.shape.kind, Pose::Identity(), v.shape.size}, v.material},
                                  limb.link == &link});
    }
}

void Robot::surround(std::span<const Solid> still, std::span<const MovingSolid> moving, double step) {
    const auto make = [&](std::string_view sensor, Stream use,
                          std::vector<double>& cells) -> std::optional<Scan> {
        const auto found = std::find_if(range_sensors.begin(), range_sensors.end(),
                                        [&](const RangeSensor& s) { return s.name == sensor; });
        if (found == range_sensors.end()) return {};
        Scan scan{RangeScanner(*found, link_pose),
                  random(use),
                  SensorClock(found->rate, step),
                  0,
                  {},
                  {},
                  std::vector<double>(static_cast<std::size_t>(found->rays))};
        for (const Solid& solid : still)
            if (const auto outline = cut(solid, scan.scanner.height())) scan.around.push_back(*outline);
        for (const MovingSolid& m : moving)
            if (const auto outline = cut(m.solid, scan.scanner.height());
                outline && !(m.body == number && m.of_body))
                scan.moving.push_back({m.body, m.hinge, *outline});
        scan.still = scan.around.size();
        scan.around.reserve(scan.still + scan.moving.size());
        cells.assign(scan.ranges.size(), 0);
        return scan;
    };
    proximity = make("laser", proximity_noise, snapshot.proximity);
    target = make("laser_target", target_noise, snapshot.target);
    gripper = make("laser_gripper", gripper_noise, snapshot.gripper);
    if (!camera_sensor) return;
    camera_clock.emplace(camera_sensor->rate, step);
    snapshot.image_width = camera_sensor->width, snapshot.image_height = camera_sensor->height;
}

void Robot::Scan::run(const Pose2& body, std::uint64_t sample, bool with_noise, const BodyPoses& poses,
                      std::span<double> cells) {
    around.resize(still);
    std::size_t framed = poses.bodies.size();
    Frame frame(0, 0, 1, 0);
    const double farthest = scanner.farthest();
    for (const MovingOutline& m : moving) {
        if (!poses.present[m.body]) continue;
        const Pose2& there = poses.bodies[m.body];
        const double near = farthest + m.far(poses), dx = there.x - body.x, dy = there.y - body.y;
        if (dx * dx + dy * dy > near * near) continue;
        if (framed != m.body) framed = m.body, frame = Frame(there);
        around.push_back(m.at(poses, frame));
    }
    scanner.scan(body, around, ranges);
    if (with_noise) scanner.add_noise(ranges, noise, sample);
    scanner.to_activity(ranges, cells);
}

void Robot::checkpoint(Archive& archive) {
    archive.same(name, "a robot");
    archive(pose, command, hinges, transceiver);
    if (reset) archive(*reset);
    archive(*trials, snapshot, history);
    for (std::optional<Scan>* scan : {&proximity, &target, &gripper})
        if (*scan) archive((*scan)->clock);
    if (!wants_image) return;  // no module looks: what a film sees decides nothing
    archive(snapshot.image, rendered);
    if (camera_clock) archive(*camera_clock);
    for (BugSnapshot& s : history) archive(s.image);
}

void Robot::sense(bool with_noise, std::uint64_t sample, const BodyPoses& poses) {
    snapshot.pose = pose;
    if (proximity) proximity->run(pose, sample, with_noise, poses, snapshot.proximity);
    if (target) target->run(pose, sample, with_noise, poses, snapshot.target);
    if (gripper && wants_gripper_scan) gripper->run(pose, sample, with_noise, poses, snapshot.gripper);
}

bool Robot::due(double now) const {
    const auto is_due = [&](const std::optional<Scan>& scan) { return scan && scan->clock.due(now); };
    return !proximity || is_due(proximity) || is_due(target) || (wants_gripper_scan && is_due(gripper)) ||
           (wants_image && camera_clock && camera_clock->due(now));
}

void Robot::sense_due(double now, bool with_noise, const BodyPoses& poses, std::span<const MovingVisual> all) {
    const auto look = [&](std::optional<Scan>& scan, std::vector<double>& cells) {
        if (!scan || !scan->clock.due(now)) return false;
        scan->run(pose, scan->clock.look(now), with_noise, poses, cells);
        return true;
    };
    if (look(proximity, snapshot.proximity) || !proximity) snapshot.pose = pose;
    look(target, snapshot.target);
    if (wants_gripper_scan) look(gripper, snapshot.gripper);
    if (wants_image && camera_clock && camera_clock->due(now))
        render(with_noise, camera_clock->look(now), poses, all);
}

void Robot::make_camera(std::shared_ptr<const Scene> scene) {
    if (!camera_sensor || camera) return;
    camera.emplace(*camera_sensor, link_pose, std::move(scene));
    const auto values =
        3 * static_cast<std::size_t>(camera->width()) * static_cast<std::size_t>(camera->height());
    picture_.resize(values);
    snapshot.image.resize(values);
}

void Robot::render(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                   std::span<const MovingVisual> all) {
    if (!camera || rendered == sample) return;
    take_picture(with_noise, sample, poses, all, snapshot.image);
    rendered = sample;
}

std::span<const std::uint8_t> Robot::view(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                                          std::span<const MovingVisual> all) {
    if (!camera) return {};
    view_.resize(picture_.size());
    take_picture(with_noise, sample, poses, all, view_);
    return view_;
}

void Robot::take_picture(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                         std::span<const MovingVisual> all, std::vector<std::uint8_t>& out) {
    moving_.clear();
    for (const MovingVisual& moving : all)
        if (!(moving.body == number && moving.of_body) && poses.present[moving.body])
            moving_.push_back(&moving.visual);
    camera->render(pose, moving_, picture_);
    if (with_noise) {
        camera->quantise(picture_, out, image_random, sample);
    } else {
        for (std::size_t i = 0; i < picture_.size(); ++i)
            out[i] = static_cast<std::uint8_t>(std::clamp(picture_[i], 0.0f, 1.0f) * 255 + 0.5f);
    }
}

void Robot::move_gripper(Physics& physics, double step) {
    for (std::size_t h = 0; h < hinges.size(); ++h) {
        const double before = hinges[h].angle, after = hinges.next(h, step);
        if (after == before) continue;
        hinges.set(h, after);
        swung_.clear();
        for (std::size_t l = 0; l < limbs.size(); ++l)
            if (hinges.turns_with(limbs[l].hinge, static_cast<int>(h)))
                swung_.emplace_back(
                    l, moved(limbs[l].home, hinges.frame(static_cast<std::size_t>(limbs[l].hinge))));
        if (!physics.swing(number, swung_)) hinges.set(h, before);
    }
}

}  // namespace forage::bug
