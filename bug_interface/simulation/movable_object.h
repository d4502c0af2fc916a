// Movable objects: models that are neither static nor robots, and that move when they are pushed.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/simulation/body_poses.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// A movable object. Its frame is that of its first link, projected onto the floor.
struct MovableObject {
    std::string name;
    Pose2 start;                        ///< pose in the world file
    std::vector<Solid> solids;          ///< collision shapes in the frame of the object
    std::vector<MovingVisual> visuals;  ///< their `body` is 0 here
    bool resource = false;              ///< whether it has the target plugin: robots collect it
};

/// Whether a model is movable: it is not static, is not a robot and has a solid collision shape.
bool is_movable(const Model& model);
/// The world without robots and movable objects.
WorldDescription static_part(WorldDescription world);
MovableObject movable_object_of(const Model& model);

/// The body of a movable model. The friction of the floor decelerates it; balls do not roll. Reports an error
/// when the world has too many heights.
Body body_of(const Model& model, const MovableObject& object, Heights& heights, Diagnostics& diagnostics);

}  // namespace forage::bug
