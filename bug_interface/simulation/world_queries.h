// Queries of a world description: robots, plugins, solids, obstacles and targets.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "bug_interface/motion/physics.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/world/description.h"

namespace forage::bug {

/// A visible solid and its colour, for drawing.
struct DrawnSolid {
    Solid solid;
    Colour colour = Colour::Zero();
};

/// Calls visit(link, pose) for each link of a model and of the models nested in it. `pose` is the pose of the
/// link in the frame of `parent`.
template <class F>
void for_each_link(const Model& model, const Pose& parent, F&& visit) {
    const Pose pose = parent * model.pose;
    for (const Link& link : model.links) visit(link, Pose(pose * link.pose));
    for (const Model& inner : model.models) for_each_link(inner, pose, visit);
}

/// The link "bug" of a model with the velocity plugin, which makes the model a robot. Null for other models.
const Link* robot_link(const Model& model);
bool has_plugin(const Model& model, std::string_view filename);

/// The collision shapes of a model in world coordinates, without planes.
std::vector<Solid> solids_of(const Model& model);

/// The middle of the heights that a solid shares with the range from `low` to `high`, m. Empty when they
/// share less than 1 mm.
std::optional<double> common_height(const Solid& solid, double low, double high);

/// The obstacles of the static models. For each layer of `heights`, a solid is cut in the middle of the
/// heights that it shares with the layer.
std::vector<Obstacle> obstacles_of(const WorldDescription& world, const Heights& heights);

/// The centres of the targets, m. A target is a cylinder in a static model that the light sensors (0.35 m
/// above the floor) see and the proximity sensors (0.175 m) do not.
std::vector<Eigen::Vector2d> targets_of(const WorldDescription& world);

/// The visible solids of all models that do not move, in the order of the file; of a link without visuals,
/// the solids that robots touch.
std::vector<DrawnSolid> drawing_of(const WorldDescription& world);

}  // namespace forage::bug
