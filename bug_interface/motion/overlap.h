// How two outlines lie to each other.
#pragma once

#include <Eigen/Core>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// How far one outline is in another one.
struct Overlap {
    double depth = 0;  ///< m that one must be moved by to be free; negative: at least so far apart
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector, the shortest way out for the second
};

/// `b` against `a`. Exact where they overlap by less than half the smaller one; apart, the depth is a bound.
Overlap overlap(const Outline& a, const Outline& b);

/// Radius of a circle round the middle of an outline, m.
double reach(const Outline& outline);

/// `outline`, given in a frame that stands at `frame`, in the frame of that.
Outline moved(const Outline& outline, const Pose2& frame);

}  // namespace forage::bug
