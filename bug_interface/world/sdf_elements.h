// The elements of a world file that hold no models: one function for each.
#pragma once

#include "bug_interface/world/sdf_source.h"

namespace forage::bug {

/// The <geometry> in `parent`.
Shape read_shape(SdfSource& in, const xml::Element& parent);
/// The <material> in `visual`, with its texture.
Material read_material(SdfSource& in, const xml::Element& visual);
/// A <link> with all that stands in it.
Link read_link(SdfSource& in, const xml::Element& e);
/// A <joint>: a hinge of `model` when it turns. Others fix their links, as everything in a model is fixed
/// here.
void read_joint(SdfSource& in, const xml::Element& e, Model& model);
/// That the hinges of `model` name links that it has.
void check_joints(SdfSource& in, const Model& model);
/// A <sensor>: scanners and cameras; others have no effect here.
void read_sensor(SdfSource& in, const xml::Element& e, Link& link);
/// The <plugin> with the rules of the game.
GameRules read_game(SdfSource& in, const xml::Element& e);

}  // namespace forage::bug
