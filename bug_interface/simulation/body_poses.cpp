#include "bug_interface/simulation/body_poses.h"

#include <algorithm>

namespace forage::bug {

void BodyPoses::sort() {
    constexpr double cell = 3;  // m; scanners and cameras reach about as far
    if (areas_.empty()) areas_.resize(bodies.size()), places.reserve(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        double turned = 0;  // how far hinges may carry a point
        for (const Pose2& hinge : hinges[i])
            turned = std::max(turned, std::sqrt(hinge.x * hinge.x + hinge.y * hinge.y));
        // A body that is not present may be anywhere, which must not stretch the grid.
        const Pose2& at = present[i] ? bodies[i] : bodies.front();
        areas_[i] = Area::around(at.x, at.y, radius[i] + turned);
    }
    places.assign(areas_, cell);
}

Pose in_space(const Pose2& pose) {
    Pose out = Pose::Identity();
    out.translation() = Eigen::Vector3d(pose.x, pose.y, 0);
    out.linear() = Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return out;
}

void MovingVisuals::add(const MovingVisual& visual) {
    if (first_.size() <= visual.body)
        first_.resize(visual.body + 1, all_.size()), placed_.resize(visual.body + 1);
    all_.push_back(visual);
}

std::span<const MovingVisual> MovingVisuals::of(std::size_t body, const BodyPoses& poses) {
    if (body >= first_.size()) return {};
    const std::size_t end = body + 1 < first_.size() ? first_[body + 1] : all_.size();
    const std::span<MovingVisual> visuals(&all_[0] + first_[body], end - first_[body]);
    if (!placed_[body]) {
        const Pose body_pose = in_space(poses.bodies[body]);
        Pose link = body_pose;
        int hinge = -1;  // the one that `link` turns with
        for (MovingVisual& v : visuals) {
            if (v.hinge != hinge)
                link = v.hinge < 0
                           ? body_pose
                           : body_pose * in_space(poses.hinges[body][static_cast<std::size_t>(v.hinge)]);
            hinge = v.hinge;
            v.visual.solid.pose = link * v.pose;
        }
        placed_[body] = 1;
    }
    return visuals;
}

}  // namespace forage::bug
