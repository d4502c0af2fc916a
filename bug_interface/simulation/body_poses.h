// Where everything is that moves, at one moment.
#pragma once

#include <cmath>
#include <vector>

#include "bug_interface/motion/overlap.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/sensing/scene.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// Bodies are counted: the robots of the world, then its loose things.
struct BodyPoses {
    std::vector<Pose2> bodies;
    std::vector<char> present;  ///< of each body; one that is taken away is neither seen nor touched
    std::vector<std::vector<Pose2>>
        hinges;  ///< of each body: how far what turns with its hinges is displaced

    void checkpoint(Archive& archive) { archive(bodies, present, hinges); }
};

/// An outline that moves with a body.
struct MovingOutline {
    std::size_t body = 0;
    int hinge = -1;   ///< that it turns with; -1: none
    Outline outline;  ///< in the body's frame, with its hinges at 0

    /// Where it is when its body stands at `frame`.
    Outline at(const BodyPoses& poses, const Frame& frame) const {
        return frame.moved(hinge < 0 ? outline : moved(outline, displaced(poses)));
    }
    /// How far any of it is from the middle of its body at most, m.
    double far(const BodyPoses& poses) const {
        const auto from_middle = [](const auto& at) { return std::sqrt(at.x * at.x + at.y * at.y); };
        const double home = from_middle(outline) + reach(outline);
        return hinge < 0 ? home : home + from_middle(displaced(poses));
    }

  private:
    const Pose2& displaced(const BodyPoses& poses) const {
        return poses.hinges[body][static_cast<std::size_t>(hinge)];
    }
};

/// A solid that moves with a body.
struct MovingSolid {
    std::size_t body = 0;
    int hinge = -1;
    Solid solid;           ///< in the body's frame, with its hinges at 0
    bool of_body = false;  ///< of a robot's body itself
};

/// The pose in space of something that stands on the floor.
Pose in_space(const Pose2& pose);

/// Something visible that moves with a body.
struct MovingVisual {
    std::size_t body = 0;
    int hinge = -1;
    Pose pose = Pose::Identity();  ///< in the body's frame, with its hinges at 0
    VisualSolid visual;
    bool of_body = false;  ///< of a robot's body itself, which its own camera looks away from

    Pose at(const BodyPoses& poses) const {
        const Pose there = in_space(poses.bodies[body]);
        return hinge < 0 ? there * pose
                         : there * in_space(poses.hinges[body][static_cast<std::size_t>(hinge)]) * pose;
    }
};

}  // namespace forage::bug
