// What stands still in a world, sorted by who wants to know about it.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "bug_interface/motion/physics.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// A solid with its colour, for drawing.
struct DrawnSolid {
    Solid solid;
    Colour colour = Colour::Zero();
};

/// Calls visit(link, pose of the link in the frame of `parent`) for the links of a model and of the models in
/// it.
template <class F>
void each_link(const Model& model, const Pose& parent, F&& visit) {
    const Pose pose = parent * model.pose;
    for (const Link& link : model.links) visit(link, Pose(pose * link.pose));
    for (const Model& inner : model.models) each_link(inner, pose, visit);
}

/// The link that makes a model a robot ("bug", driven by the velocity plugin); null when it is none.
const Link* robot_link(const Model& model);
bool has_plugin(const Model& model, std::string_view filename);

/// The collision shapes of a model that are solids (no planes), in the world.
std::vector<Solid> solids_of(const Model& model);

/// Height of the middle of what `solid` and the heights low..high share, m; empty when they share less than 1
/// mm.
std::optional<double> common_height(const Solid& solid, double low, double high);

/// What bodies bump into, in static models: for each layer of `heights` the outline at the middle of the
/// heights that it shares with a solid.
std::vector<Obstacle> obstacles_of(const WorldDescription& world, const Heights& heights);

/// The middles of all targets: cylinders in static models that the light sensors (at 0.35 m) meet and the
/// proximity sensors (at 0.175 m) do not.
std::vector<Eigen::Vector2d> targets_of(const WorldDescription& world);

/// What a map of the world shows: the visible solids of everything that stands still, in file order.
std::vector<DrawnSolid> drawing_of(const WorldDescription& world);

}  // namespace forage::bug
