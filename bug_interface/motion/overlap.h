// How two outlines lie to each other.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "bug_interface/sensing/outline.h"

namespace forage::bug {

/// How far one outline is in another one.
struct Overlap {
    double depth = 0;  ///< m that one must be moved by to be free; negative: at least so far apart
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector, the shortest way out for the second
};

/// `b` against `a`. Exact where they overlap by less than half the smaller one; apart, the depth is a bound.
/// Who wants to know only of what is deeper than `least` may get any depth up to `least` instead.
Overlap overlap(const Outline& a, const Outline& b, double least = -std::numeric_limits<double>::infinity());

/// Radius of a circle round the middle of an outline, m.
double reach(const Outline& outline);

/// A frame that stands somewhere in the plane.
class Frame {
  public:
    explicit Frame(const Pose2& at) : Frame(at.x, at.y, std::cos(at.yaw), std::sin(at.yaw)) {}
    Frame(double x, double y, double cos_yaw, double sin_yaw) : x_(x), y_(y), cos_(cos_yaw), sin_(sin_yaw) {}
    double x() const { return x_; }
    double y() const { return y_; }
    /// `outline`, given in this frame, in the frame in which this one stands.
    Outline moved(const Outline& outline) const;

  private:
    double x_, y_, cos_, sin_;
};
inline Outline moved(const Outline& outline, const Pose2& frame) { return Frame(frame).moved(outline); }

}  // namespace forage::bug
