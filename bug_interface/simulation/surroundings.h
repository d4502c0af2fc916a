// What never moves in a world.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/scene.h"
#include "bug_interface/simulation/patches.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// What cameras see of the static models of a world, and the patches on its floors: most of the time and
/// memory that a world takes to begin. Worlds with the same description share it, in any threads. Each part
/// is made when it is first asked for. Throws std::runtime_error then when the picture of a floor cannot be
/// read.
class Surroundings {
  public:
    explicit Surroundings(const WorldDescription& world);
    std::shared_ptr<const Scene> scene();
    const std::vector<Patch>& patches();
    /// A new camera of a robot, to copy: its tables take most of the time that a further run of a world
    /// needs.
    const Camera& camera(std::size_t robot, const CameraSensor& sensor, const Pose& link_pose);

  private:
    WorldDescription still_;
    std::mutex making_;
    std::shared_ptr<const Scene> scene_;
    std::optional<std::vector<Patch>> patches_;
    std::map<std::size_t, Camera> cameras_;  ///< by robot
};

}  // namespace forage::bug
