// The penetration depth of two outlines.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// How far two outlines penetrate each other.
struct Overlap {
    double depth = 0;  ///< penetration depth, m; negative values are a lower bound of the gap
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector; moves the second outline out
};

/// The overlap of `b` with `a`. The depth is exact when it is less than half the smaller outline. For
/// outlines apart, -depth is a lower bound of the gap. Any depth up to `least` may be returned for depths
/// below `least`, which saves time.
Overlap overlap(const Outline& a, const Outline& b, double least = -std::numeric_limits<double>::infinity());

/// The distance from the point (x, y) to an outline, m; 0 inside.
double distance_to(const Outline& outline, double x, double y);

}  // namespace forage::bug
