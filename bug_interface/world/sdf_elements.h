// The elements of a world file that hold no models: one function for each.
#pragma once

#include "bug_interface/world/sdf_source.h"

namespace forage::bug {

/// The <geometry> in `parent`.
Shape read_shape(SdfSource& in, const sdf::ElementPtr& parent);
/// The <material> in `visual`, with its texture.
Material read_material(SdfSource& in, const sdf::ElementPtr& visual);
/// A <link> with all that stands in it.
Link read_link(SdfSource& in, const sdf::ElementPtr& e);
/// A <joint>: a hinge of `model` when it turns. Others fix their links, as everything in a model is fixed
/// here.
void read_joint(SdfSource& in, const sdf::ElementPtr& e, Model& model);
/// A <sensor>: scanners and cameras; others have no effect here.
void read_sensor(SdfSource& in, const sdf::ElementPtr& e, Link& link);
/// The <plugin> with the rules of the game.
GameRules read_game(SdfSource& in, const sdf::ElementPtr& e);

}  // namespace forage::bug
