// A world from above.
#pragma once

#include <Eigen/Geometry>

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

// Of lines in a world's map.
inline constexpr Colour near_ray{0.95, 0.25, 0.15}, light_ray{0.95, 0.75, 0.05}, site_colour{0.1, 0.2, 0.9},
    bounds_colour{0.65, 0.65, 0.65};

/// Whether teams bring something home in it.
bool has_homes(const bug::World& world);

/// Draws a world into a rectangle of a picture, y upwards. The world must outlive it.
class WorldMap {
  public:
    using Box = Eigen::AlignedBox2d;

    /// What is shown: bounds, walls, targets, robots and `extra`, m, and a little more. The longer side has
    /// `pixels`; the upper left corner stands at (left, top).
    WorldMap(const bug::World& world, const Box& extra, double pixels, double left, double top);

    double width() const { return view_.sizes().x() * scale_; }   ///< pixels
    double height() const { return view_.sizes().y() * scale_; }  ///< pixels
    const Box& view() const { return view_; }                     ///< m
    double scale() const { return scale_; }                       ///< pixels per metre
    double px(double x) const { return left_ + (x - view_.min().x()) * scale_; }
    double py(double y) const { return top_ + (view_.max().y() - y) * scale_; }

    void draw_ground(Canvas& canvas) const;   ///< floors, then what stands still, from the lowest top up
    void draw_loose(Canvas& canvas) const;    ///< what can be pushed, where it is now
    void draw_marks(Canvas& canvas) const;    ///< bounds and starts
    void draw_targets(Canvas& canvas) const;  ///< the rings that count as reached
    /// A robot where it is now, with its gripper; with `rays` also what its ray sensors see.
    void draw_robot(Canvas& canvas, std::size_t robot, bool rays) const;

  private:
    void draw_floor(Canvas& canvas, const bug::FloorSurface& floor) const;
    void draw_solid(Canvas& canvas, const bug::DrawnSolid& solid) const;
    void draw_rays(Canvas& canvas, std::size_t robot) const;

    const bug::World& world_;
    Box view_;
    double left_, top_, scale_;
};

/// The world as it is now, as a picture with axes and the names of its robots.
Picture world_plot(const bug::World& world, const std::string& title);

}  // namespace forage::plot
