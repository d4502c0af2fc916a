#include "bug_interface/motion/gripper.h"

#include <algorithm>
#include <cmath>

namespace forage::bug {
namespace {

/// The links of `model`, whose frame is `frame` in the robot's.
void collect(const Model& model, const Pose& frame, std::vector<Limb>& limbs,
             std::vector<const Hinge*>& hinges, std::vector<int>& first_limb) {
    const auto first = limbs.size();
    for (const Link& link : model.links) limbs.push_back({&link, frame * link.pose, -1});
    for (const Hinge& hinge : model.hinges)
        hinges.push_back(&hinge), first_limb.push_back(static_cast<int>(first));
    for (const Model& inner : model.models) collect(inner, frame * inner.pose, limbs, hinges, first_limb);
}

}  // namespace

std::vector<Limb> limbs_of(const Model& model, Hinges& hinges) {
    std::vector<Limb> limbs;
    std::vector<const Hinge*> found;
    std::vector<int> first_limb;  // of the model that a hinge stands in
    collect(model, Pose::Identity(), limbs, found, first_limb);
    const auto limb = [&](std::size_t hinge, const std::string& name) {
        const std::string own = name.substr(name.rfind(':') + 1);
        const auto from = limbs.begin() + first_limb[hinge];
        return std::find_if(from, limbs.end(), [&](const Limb& l) { return l.link->name == own; });
    };
    for (std::size_t h = 0; h < found.size(); ++h) {
        const auto child = limb(h, found[h]->child);
        if (child == limbs.end() || child->hinge >= 0) continue;
        const Pose axis = child->home * found[h]->pose;
        child->hinge = static_cast<int>(hinges.all_.size());
        hinges.all_.push_back({found[h]->name, -1, axis.translation().x(), axis.translation().y(),
                               found[h]->sense, found[h]->lower, found[h]->upper, 0, 0});
    }
    std::size_t made = 0;
    for (std::size_t h = 0; h < found.size(); ++h) {
        const auto child = limb(h, found[h]->child), parent = limb(h, found[h]->parent);
        if (child == limbs.end() || child->hinge != static_cast<int>(made)) continue;
        if (parent != limbs.end() && !hinges.turns_with(parent->hinge, static_cast<int>(made)))
            hinges.all_[made].parent = parent->hinge;
        ++made;
    }
    for (const Limb& l : limbs)
        for (int h = l.hinge; h >= 0; h = hinges.all_[static_cast<std::size_t>(h)].parent)
            hinges.all_[static_cast<std::size_t>(h)].inertia += l.link->inertia_z;
    return limbs;
}

void Hinges::command(bool close) {
    if (close == told_to_close_) return;
    told_to_close_ = close;
    torque_ = close ? torque : -torque;
}

double Hinges::next(std::size_t i, double step) const {
    const Hinge& h = all_[i];
    return std::clamp(h.angle + torque_ / h.inertia * step * step, h.lower, h.upper);
}

Pose2 Hinges::frame(std::size_t i) const {
    const Hinge& h = all_[i];
    const double turn = h.sense * h.angle, c = std::cos(turn), s = std::sin(turn);
    const Pose2 own{h.x - c * h.x + s * h.y, h.y - s * h.x - c * h.y, turn};
    if (h.parent < 0) return own;
    const Pose2 carrier = frame(static_cast<std::size_t>(h.parent));
    const double cc = std::cos(carrier.yaw), cs = std::sin(carrier.yaw);
    return {carrier.x + cc * own.x - cs * own.y, carrier.y + cs * own.x + cc * own.y, carrier.yaw + own.yaw};
}

bool Hinges::turns_with(int i, int by) const {
    for (; i >= 0; i = all_[static_cast<std::size_t>(i)].parent)
        if (i == by) return true;
    return false;
}

}  // namespace forage::bug
