#include "bug_interface/simulation/surroundings.h"

#include "bug_interface/simulation/movable_object.h"

namespace forage::bug {

Surroundings::Surroundings(const WorldDescription& world) : still_(static_part(world)) {}

std::shared_ptr<const Scene> Surroundings::scene() {
    const std::lock_guard lock(making_);
    if (!scene_) scene_ = std::make_shared<const Scene>(still_);
    return scene_;
}

const std::vector<Patch>& Surroundings::patches() {
    const auto seen = scene();
    const std::lock_guard lock(making_);
    if (!patches_) patches_ = patches_of(seen->floors());
    return *patches_;
}

const Camera& Surroundings::camera(std::size_t robot, const CameraSensor& sensor, const Pose& link_pose) {
    const auto seen = scene();
    const std::lock_guard lock(making_);
    return cameras_.try_emplace(robot, sensor, link_pose, seen).first->second;
}

}  // namespace forage::bug
