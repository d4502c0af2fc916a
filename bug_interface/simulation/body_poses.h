// The poses of all bodies at one moment, and outlines, solids and visuals that move with a body.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bug_interface/sensing/grid.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/sensing/scene.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// Bodies are numbered: the robots of the world, then its movable objects.
struct BodyPoses {
    std::vector<Pose2> bodies;
    std::vector<char> present;               ///< per body; a removed body is neither seen nor touched
    std::vector<std::vector<Pose2>> hinges;  ///< per body and hinge: the displacement of the turned links
    /// Per body: an upper bound of the distance of its points from its origin, with its hinges at angle 0, m.
    std::vector<double> radius;
    Grid places;  ///< finds bodies by their place; made by sort()

    /// Makes `places` from the poses.
    void sort();

    void checkpoint(Archive& archive) { archive(bodies, present, hinges); }

  private:
    std::vector<Area> areas_;
};

/// An outline that moves with a body.
struct MovingOutline {
    std::size_t body = 0;
    int hinge = -1;   ///< the hinge that moves the outline; -1 for none
    Outline outline;  ///< in the frame of the body, with its hinges at angle 0

    /// The outline in world coordinates. `body_pose` is the pose of the body.
    Outline at(const BodyPoses& poses, const Transform2& body_pose) const {
        return body_pose * (hinge < 0 ? outline : Transform2(displacement(poses)) * outline);
    }
    /// An upper bound of the distance of any point of the outline from the origin of the body, m.
    double max_distance(const BodyPoses& poses) const {
        const auto from_origin = [](const auto& at) { return std::sqrt(at.x * at.x + at.y * at.y); };
        const double at_home = from_origin(outline) + bounding_radius(outline);
        return hinge < 0 ? at_home : at_home + from_origin(displacement(poses));
    }

  private:
    const Pose2& displacement(const BodyPoses& poses) const {
        return poses.hinges[body][static_cast<std::size_t>(hinge)];
    }
};

/// A solid that moves with a body.
struct MovingSolid {
    std::size_t body = 0;
    int hinge = -1;                ///< the hinge that moves the solid; -1 for none
    Solid solid;                   ///< in the frame of the body, with its hinges at angle 0
    bool is_central_disc = false;  ///< whether it is the cylinder of a robot's body
};

/// The three-dimensional pose of an object on the floor.
Pose in_space(const Pose2& pose);

/// A visual that moves with a body.
struct MovingVisual {
    std::size_t body = 0;
    int hinge = -1;                ///< the hinge that moves the visual; -1 for none
    Pose pose = Pose::Identity();  ///< in the frame of the body, with its hinges at angle 0
    VisualSolid visual;
    bool of_body_link = false;  ///< whether it belongs to the link of a robot's body, which its own camera
                                ///< does not see

    /// The pose of the visual in world coordinates.
    Pose at(const BodyPoses& poses) const {
        const Pose body_pose = in_space(poses.bodies[body]);
        return hinge < 0 ? body_pose * pose
                         : body_pose * in_space(poses.hinges[body][static_cast<std::size_t>(hinge)]) * pose;
    }
};

/// The visuals of all bodies. They are placed in the world when they are asked for.
class MovingVisuals {
  public:
    /// Bodies are added in the order of their numbers.
    void add(const MovingVisual& visual);
    /// The bodies have moved.
    void forget_places() { placed_.assign(placed_.size(), 0); }
    /// The visuals of a body, placed at `poses`.
    std::span<const MovingVisual> of(std::size_t body, const BodyPoses& poses);

    auto begin() { return all_.begin(); }
    auto end() { return all_.end(); }
    const std::vector<MovingVisual>& all() const { return all_; }

  private:
    std::vector<MovingVisual> all_;
    std::vector<std::size_t> first_;  ///< per body: its first visual
    std::vector<char> placed_;        ///< per body
};

}  // namespace forage::bug
