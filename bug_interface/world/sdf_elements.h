// Reads the elements of a world file that contain no models, with one function for each.
#pragma once

#include "bug_interface/world/sdf_source.h"

namespace forage::bug {

/// Whether the <geometry> in `parent` is one that read_shape() reads.
bool is_simple_shape(const xml::Element& parent);
/// Reads the <geometry> in `parent`.
Shape read_shape(SdfSource& in, const xml::Element& parent);
/// Reads the <material> in `visual`, with its texture.
Material read_material(SdfSource& in, const xml::Element& visual);
/// Reads a <link> with everything in it.
Link read_link(SdfSource& in, const xml::Element& e);
/// Reads a <joint>. A joint that turns becomes a hinge of `model`; other joints have no effect, as the links
/// of a model are fixed to each other anyway.
void read_joint(SdfSource& in, const xml::Element& e, Model& model);
/// Reports hinges of `model` that name links which the model does not have.
void check_joints(SdfSource& in, const Model& model);
/// Reads a <sensor>: a range scanner or a camera. Other sensors have no effect.
void read_sensor(SdfSource& in, const xml::Element& e, Link& link);
/// Reads the <plugin> with the rules of the game.
GameRules read_game(SdfSource& in, const xml::Element& e);
/// Reads the <plugin> with the rules of trials.
TrialRules read_trials(SdfSource& in, const xml::Element& e);

}  // namespace forage::bug
