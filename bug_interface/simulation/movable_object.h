// Loose things: what is neither fixed nor a robot, and moves when it is pushed.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/motion/physics.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/simulation/body_poses.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// A loose model. Its frame is that of its first link, laid flat.
struct MovableObject {
    std::string name;
    Pose2 start;                      ///< where the file puts it
    std::vector<Solid> solids;        ///< its collision shapes, in its frame
    std::vector<MovingVisual> visuals;  ///< `body` is 0 here
    bool resource = false;            ///< whether it has the target plugin: robots collect it
};

/// Whether a model is loose: not static, no robot, and solid.
bool is_movable(const Model& model);
/// A world without robots and loose things, for what stands still.
WorldDescription without_movers(WorldDescription world);
MovableObject movable_object_of(const Model& model);

/// The body of a loose model. The floor slows it down by its friction; it does not roll. An error when its
/// heights are too many.
Body body_of(const Model& model, const MovableObject& object, Heights& heights, Diagnostics& diagnostics);

/// Where a model's frame as a object is, seen from the model.
Pose frame_of(const Model& model);

}  // namespace forage::bug
