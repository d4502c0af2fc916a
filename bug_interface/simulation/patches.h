// The coloured patches on the floor: what a robot can tell places by.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "bug_interface/sensing/scene.h"

namespace forage::bug {

/// A coloured region of a floor's picture, surrounded by black, grey or white.
struct Patch {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< centre of gravity, m
    double radius = 0;                                 ///< of a disc of the same area, m
    std::string colour;  ///< at the middle: one of twelve hues, "red", "orange", "yellow", ... "rose"
};

/// The patches with a radius of at least 0.05 m, row by row from the top of each floor's picture. Places are
/// good to 2 cm on a floor of 8 m (pictures are looked at with 512 pixels a side). Patches that touch each
/// other count as one.
std::vector<Patch> patches_of(std::span<const FloorSurface> floors);

/// The patch in which `place` lies, or none (-1); the first when several overlap.
int patch_at(std::span<const Patch> patches, const Eigen::Vector2d& place);

}  // namespace forage::bug
