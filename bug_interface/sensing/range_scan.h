// Planar range scanners: distances along horizontal rays.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// Scans like the ray sensors of the original. A ray starts at the sensor's minimum range, passes through
/// everything nearer, and measures the distance from the sensor to the first surface. When a ray starts
/// inside a solid, that is the surface where it leaves the solid. A ray that meets nothing measures the
/// maximum range.
class RangeScanner {
  public:
    /// `link_pose` is the pose of the sensor's link in the robot.
    RangeScanner(const RangeSensor& sensor, const Pose& link_pose);

    double height() const { return height_; }  ///< height of all rays above the floor, m
    int rays() const { return static_cast<int>(direction_x_.size()); }
    double min_range() const { return min_; }  ///< m
    double max_range() const { return max_; }  ///< m
    /// Distance from the origin of the robot beyond which nothing is measured, m.
    double reach() const { return max_ + std::hypot(mount_.x, mount_.y); }

    /// Measures without noise. ranges[i] becomes the measurement of ray i, m; its size is rays(). `robot` is
    /// the pose of the robot in the world, and `outlines` are cross-sections at height(). Does not allocate
    /// memory.
    void scan(const Pose2& robot, std::span<const Outline> outlines, std::span<double> ranges) const;

    /// Adds normally distributed noise to each range and clamps it to [min_range(), max_range()]. `sample` is
    /// the number of the scan; the same sample has the same noise.
    void add_noise(std::span<double> ranges, const RandomStream& random, std::uint64_t sample) const;

    /// Converts ranges to activities in 0..1, which are high for near surfaces: cells[k] = (max -
    /// ranges[n-1-k]) / max. Cell 0 is the leftmost ray.
    void to_activity(std::span<const double> ranges, std::span<double> cells) const;

  private:
    Pose2 mount_;  ///< pose of the sensor in the robot
    double height_, min_, max_, noise_;
    std::vector<double> direction_x_, direction_y_;  ///< unit vectors of the rays in the frame of the robot
};

}  // namespace forage::bug
