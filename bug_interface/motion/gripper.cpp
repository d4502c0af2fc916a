#include "bug_interface/motion/gripper.h"

#include <algorithm>
#include <cmath>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {
namespace {

/// Adds the links and hinges of `model` and of the models nested in it. `frame` is the pose of the model in
/// the robot. `first_link` has, for each hinge, the number of the first link of its model.
void collect(const Model& model, const Pose& frame, std::vector<RobotLink>& links,
             std::vector<const Hinge*>& hinges, std::vector<int>& first_link) {
    const auto first = links.size();
    for (const Link& link : model.links) links.push_back({&link, frame * link.pose, -1});
    for (const Hinge& hinge : model.hinges)
        hinges.push_back(&hinge), first_link.push_back(static_cast<int>(first));
    for (const Model& inner : model.models) collect(inner, frame * inner.pose, links, hinges, first_link);
}

}  // namespace

std::vector<RobotLink> links_of(const Model& model, Hinges& hinges) {
    std::vector<RobotLink> links;
    std::vector<const Hinge*> described;
    std::vector<int> first_link;
    collect(model, Pose::Identity(), links, described, first_link);
    const auto find_link = [&](std::size_t hinge, const std::string& name) {
        const std::string own_name = name.substr(name.rfind(':') + 1);
        return std::find_if(links.begin() + first_link[hinge], links.end(),
                            [&](const RobotLink& l) { return l.link->name == own_name; });
    };
    for (std::size_t h = 0; h < described.size(); ++h) {
        const Hinge& hinge = *described[h];
        const auto child = find_link(h, hinge.child);
        if (child == links.end() || child->hinge >= 0) continue;
        const Pose axis = child->home * hinge.pose;
        child->hinge = static_cast<int>(hinges.all_.size());
        hinges.all_.push_back({hinge.name, -1, axis.translation().x(), axis.translation().y(), hinge.sense,
                               hinge.lower, hinge.upper, 0, 0});
    }
    std::size_t number = 0;  // of the hinge in `hinges`
    for (std::size_t h = 0; h < described.size(); ++h) {
        const auto child = find_link(h, described[h]->child), parent = find_link(h, described[h]->parent);
        if (child == links.end() || child->hinge != static_cast<int>(number)) continue;
        if (parent != links.end() && !hinges.turns_with(parent->hinge, static_cast<int>(number)))
            hinges.all_[number].parent = parent->hinge;
        ++number;
    }
    for (const RobotLink& l : links)
        for (int h = l.hinge; h >= 0; h = hinges.all_[static_cast<std::size_t>(h)].parent)
            hinges.all_[static_cast<std::size_t>(h)].inertia += l.link->inertia_z;
    return links;
}

void Hinges::command(bool close) {
    if (close == close_command_) return;
    close_command_ = close;
    torque_ = close ? torque : -torque;
}

double Hinges::next(std::size_t i, double step, std::uint64_t steps) const {
    const Hinge& h = all_[i];
    const double per_step = torque_ / h.inertia * step * step;
    return std::clamp(h.angle + static_cast<double>(steps) * per_step, h.lower, h.upper);
}

Pose2 Hinges::displacement(std::size_t i) const {
    const Hinge& h = all_[i];
    const double turn = h.sense * h.angle, c = std::cos(turn), s = std::sin(turn);
    const Pose2 own{h.x - c * h.x + s * h.y, h.y - s * h.x - c * h.y, turn};
    if (h.parent < 0) return own;
    const Pose2 carrier = displacement(static_cast<std::size_t>(h.parent));
    const Eigen::Vector2d shift = Transform2(carrier) * Eigen::Vector2d(own.x, own.y);
    return {shift.x(), shift.y(), carrier.yaw + own.yaw};
}

bool Hinges::turns_with(int i, int other) const {
    for (; i >= 0; i = all_[static_cast<std::size_t>(i)].parent)
        if (i == other) return true;
    return false;
}

}  // namespace forage::bug
