// The coloured patches on the floor, by which a robot can recognise places.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "bug_interface/sensing/scene.h"

namespace forage::bug {

/// A coloured region of a floor's picture, surrounded by black, grey or white.
struct Patch {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< centre of gravity, m
    double radius = 0;                                 ///< radius of a disc with the same area, m
    std::string colour;  ///< hue at the centre, one of twelve: "red", "orange", "yellow", ... "rose"
};

/// The patches with a radius of at least 0.05 m, row by row from the top of each floor's picture. Their
/// positions are accurate to 2 cm on a floor of 8 m, as pictures are reduced to at most 512 pixels per side.
/// Patches that touch each other count as one.
std::vector<Patch> patches_of(std::span<const FloorSurface> floors);

/// The number of the first patch that contains `point` (m), or -1.
int patch_at(std::span<const Patch> patches, const Eigen::Vector2d& point);

}  // namespace forage::bug
