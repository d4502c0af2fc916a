#include "bug_interface/simulation/robot_sensors.h"

#include <algorithm>

#include "bug_interface/sensing/solid_ray.h"

namespace forage::bug {

RandomStream robot_stream(std::uint64_t seed, const std::string& robot, RobotStream use) {
    return {seed, "bug " + robot, static_cast<std::uint32_t>(use)};
}

RobotSensors::RobotSensors(const Link& link, const std::string& robot, std::size_t body, std::uint64_t seed,
                           bool noise)
    : robot_(robot),
      body_(body),
      seed_(seed),
      noise_(noise),
      link_pose_(link.pose),
      range_sensors_(link.range_sensors),
      image_noise_(robot_stream(seed, robot, RobotStream::image_noise)) {
    if (!link.cameras.empty()) camera_sensor_ = link.cameras.front();
}

std::optional<RobotSensors::Scan> RobotSensors::make_scan(RangePurpose purpose, RobotStream use,
                                                          std::span<const Solid> fixed,
                                                          std::span<const MovingSolid> moving, double step,
                                                          std::vector<double>& cells) const {
    const auto found = std::ranges::find(range_sensors_, purpose, &RangeSensor::purpose);
    if (found == range_sensors_.end()) return {};
    Scan scan{RangeScanner(*found, link_pose_),
              robot_stream(seed_, robot_, use),
              SensorClock(found->rate, step),
              {},
              {},
              {},
              {},
              {},
              std::vector<double>(static_cast<std::size_t>(found->rays))};
    const double height = scan.scanner.height();
    std::vector<Area> areas;
    for (const Solid& solid : fixed)
        if (const auto outline = cross_section(solid, height)) {
            scan.fixed.push_back(*outline);
            areas.push_back(area_of(solid));
        }
    scan.fixed_places.assign(areas, scan.scanner.max_range());
    for (const MovingSolid& m : moving) {
        scan.first_of_body.resize(m.body + 1, scan.moving.size());
        if (const auto outline = cross_section(m.solid, height);
            outline && !(m.body == body_ && m.is_central_disc))
            scan.moving.push_back({m.body, m.hinge, *outline});
    }
    scan.first_of_body.push_back(scan.moving.size());
    scan.outlines.reserve(scan.fixed.size() + scan.moving.size());
    cells.assign(scan.ranges.size(), 0);
    return scan;
}

void RobotSensors::make_scanners(std::span<const Solid> fixed, std::span<const MovingSolid> moving,
                                 double step) {
    const auto make = [&](RangePurpose purpose, RobotStream use, std::vector<double>& cells) {
        return make_scan(purpose, use, fixed, moving, step, cells);
    };
    proximity_ = make(RangePurpose::proximity, RobotStream::proximity_noise, snapshot_.proximity);
    target_ = make(RangePurpose::light, RobotStream::target_noise, snapshot_.target);
    gripper_ = make(RangePurpose::gripper, RobotStream::gripper_noise, snapshot_.gripper);
    if (!camera_sensor_) return;
    camera_clock_.emplace(camera_sensor_->rate, step);
    snapshot_.image_width = camera_sensor_->width, snapshot_.image_height = camera_sensor_->height;
}

void RobotSensors::Scan::measure(const Pose2& robot, std::uint64_t sample, bool with_noise,
                                 const BodyPoses& poses, std::span<double> cells) {
    outlines.clear();
    const Area reached = Area::around(robot.x, robot.y, scanner.reach());
    fixed_places.visit(reached, [&](std::size_t i) { outlines.push_back(fixed[i]); });
    poses.places.visit(reached, [&](std::size_t body) {
        if (!poses.present[body] || first_of_body[body] == first_of_body[body + 1]) return;
        const Pose2& pose = poses.bodies[body];
        const Transform2 body_pose(pose);
        for (std::size_t i = first_of_body[body]; i < first_of_body[body + 1]; ++i)
            outlines.push_back(moving[i].at(poses, body_pose));
    });
    scanner.scan(robot, outlines, ranges);
    if (with_noise) scanner.add_noise(ranges, noise, sample);
    scanner.to_activity(ranges, cells);
}

void RobotSensors::scan(std::uint64_t sample, const BodyPoses& poses) {
    const Pose2& pose = snapshot_.pose = poses.bodies[body_];
    if (proximity_) proximity_->measure(pose, sample, noise_, poses, snapshot_.proximity);
    if (target_) target_->measure(pose, sample, noise_, poses, snapshot_.target);
    if (gripper_ && gripper_requested_) gripper_->measure(pose, sample, noise_, poses, snapshot_.gripper);
}

bool RobotSensors::due(double now) const {
    const auto is_due = [&](const std::optional<Scan>& scan) { return scan && scan->clock.due(now); };
    return !proximity_ || is_due(proximity_) || is_due(target_) || (gripper_requested_ && is_due(gripper_)) ||
           (image_requested_ && camera_clock_ && camera_clock_->due(now));
}

void RobotSensors::sense_due(double now, const BodyPoses& poses, MovingVisuals& visuals) {
    const Pose2& pose = poses.bodies[body_];
    const auto sense = [&](std::optional<Scan>& scan, std::vector<double>& cells) {
        if (!scan || !scan->clock.due(now)) return false;
        scan->measure(pose, scan->clock.sample(now), noise_, poses, cells);
        return true;
    };
    if (sense(proximity_, snapshot_.proximity) || !proximity_) snapshot_.pose = pose;
    sense(target_, snapshot_.target);
    if (gripper_requested_) sense(gripper_, snapshot_.gripper);
    if (image_requested_ && camera_clock_ && camera_clock_->due(now))
        render(camera_clock_->sample(now), poses, visuals);
}

void RobotSensors::make_camera(const Camera& like) {
    if (camera_) return;
    camera_.emplace(like).reserve();
    const auto values =
        3 * static_cast<std::size_t>(camera_->width()) * static_cast<std::size_t>(camera_->height());
    picture_.resize(values);
    snapshot_.image.resize(values);
}

void RobotSensors::render(std::uint64_t sample, const BodyPoses& poses, MovingVisuals& visuals) {
    if (!camera_ || rendered_ == sample) return;
    take_picture(sample, poses, visuals, snapshot_.image);
    rendered_ = sample;
}

std::span<const std::uint8_t> RobotSensors::view(std::uint64_t sample, const BodyPoses& poses,
                                                 MovingVisuals& visuals) {
    if (!camera_) return {};
    view_.resize(picture_.size());
    take_picture(sample, poses, visuals, view_);
    return view_;
}

/// Finds the moving solids that may be in the picture. Those that the camera has looked up come first; their
/// number is returned.
std::size_t RobotSensors::find_visible(const BodyPoses& poses, MovingVisuals& visuals) {
    const auto is_own_box = [&](const MovingVisual& v) {
        return v.body == body_ && !v.of_body_link && v.visual.solid.kind == ShapeKind::box;
    };
    visible_.clear();
    const auto parts = visuals.of(body_, poses);
    for (const MovingVisual& v : parts)
        if (is_own_box(v)) visible_.push_back(&v.visual);
    const std::size_t own = visible_.size();
    const std::vector<Pose2>& hinges = poses.hinges[body_];
    const bool moved = !std::equal(
        hinges.begin(), hinges.end(), own_hinges_.begin(), own_hinges_.end(),
        [](const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; });
    if (own > 0 && (own_.empty() || moved)) {
        own_hinges_ = hinges;
        own_.clear();
        for (const MovingVisual& v : parts) {
            if (!is_own_box(v)) continue;
            own_.push_back(v.visual);
            own_.back().solid.pose =
                v.hinge < 0 ? v.pose : in_space(hinges[static_cast<std::size_t>(v.hinge)]) * v.pose;
        }
        camera_->set_own(own_);
    }
    near_.clear();
    poses.places.visit(camera_->view_area(poses.bodies[body_]),
                       [&](std::size_t body) { near_.push_back(body); });
    std::ranges::sort(near_);  // the order decides between surfaces at the same depth
    for (const std::size_t body : near_) {
        if (!poses.present[body]) continue;
        for (const MovingVisual& v : visuals.of(body, poses))
            if (!is_own_box(v) && !(body == body_ && v.of_body_link)) visible_.push_back(&v.visual);
    }
    return own;
}

void RobotSensors::take_picture(std::uint64_t sample, const BodyPoses& poses, MovingVisuals& visuals,
                                std::vector<std::uint8_t>& out) {
    const std::size_t own = find_visible(poses, visuals);
    camera_->render(poses.bodies[body_], visible_, picture_, own);
    if (noise_) {
        camera_->quantise(picture_, out, image_noise_, sample);
    } else {
        for (std::size_t i = 0; i < picture_.size(); ++i)
            out[i] = static_cast<std::uint8_t>(std::clamp(picture_[i], 0.0f, 1.0f) * 255 + 0.5f);
    }
}

void RobotSensors::remember(std::uint64_t cycle, int latency) {
    if (latency <= 0) return;
    const auto size = static_cast<std::size_t>(latency) + 1;
    if (cycle == 0)
        history_.assign(size, snapshot_);
    else
        history_[cycle % size] = snapshot_;
}

void RobotSensors::checkpoint(Archive& archive) {
    archive(snapshot_, history_);
    for (std::optional<Scan>* scan : {&proximity_, &target_, &gripper_})
        if (*scan) archive((*scan)->clock);
    if (!image_requested_) return;  // no module uses the images, and a film does not change them
    archive(snapshot_.image, rendered_);
    if (camera_clock_) archive(*camera_clock_);
    for (BugSnapshot& s : history_) archive(s.image);
}

}  // namespace forage::bug
