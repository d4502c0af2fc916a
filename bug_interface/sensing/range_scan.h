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

/// Scans as the original's ray sensors did. A ray starts at the sensor's least range and looks through
/// everything nearer; it reports the distance from the sensor to the first surface. A ray that starts inside
/// a solid reports where it leaves it. Without a hit it reports the greatest range.
class RangeScanner {
  public:
    /// `link_in_model`: pose of the sensor's link in the model whose pose scan() gets.
    RangeScanner(const RangeSensor& sensor, const Pose& link_in_model);

    double height() const { return height_; }  ///< of all rays above the floor, m
    int rays() const { return static_cast<int>(direction_x_.size()); }
    double min_range() const { return min_; }  ///< m
    double max_range() const { return max_; }  ///< m
    /// What is farther from the middle of the model is out of range, m.
    double farthest() const { return max_ + std::hypot(mount_.x, mount_.y); }

    /// ranges[i]: what ray i measures, m, without noise; size rays(). `body`: pose of the model in the world.
    /// `outlines`: what is there, cut at height(). Allocates nothing.
    void scan(const Pose2& body, std::span<const Outline> outlines, std::span<double> ranges) const;

    /// Adds normal noise to each range, hit or not, and clamps to [min, max]. `sample` counts this sensor's
    /// scans.
    void add_noise(std::span<double> ranges, const RandomStream& random, std::uint64_t sample) const;

    /// Activity in 0..1, near is high: cells[k] = (max - ranges[n-1-k]) / max. Cell 0 is the leftmost ray.
    void to_activity(std::span<const double> ranges, std::span<double> cells) const;

  private:
    void scan_circle(double x, double y, double radius, std::span<double> ranges) const;
    void scan_box(double x, double y, double cos_yaw, double sin_yaw, double half_x, double half_y,
                  std::span<double> ranges) const;

    Pose2 mount_;  ///< of the sensor in the model
    double height_, min_, max_, noise_;
    std::vector<double> direction_x_, direction_y_;  ///< of each ray in the model's frame, unit length
};

}  // namespace forage::bug
