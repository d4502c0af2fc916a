// A map of a world, seen from above.
#pragma once

#include <Eigen/Geometry>

#include "bug_interface/simulation/world.h"
#include "tools/plot/axes.h"

namespace forage::plot {

// Colours of the lines in a map.
inline constexpr Colour near_ray{0.95, 0.25, 0.15}, light_ray{0.95, 0.75, 0.05}, site_colour{0.1, 0.2, 0.9},
    bounds_colour{0.65, 0.65, 0.65};

/// Whether the world has homes to which resources are brought.
bool has_homes(const bug::World& world);

/// Draws a world into a rectangle of a picture, with y upwards. The world must outlive the map.
class WorldMap {
  public:
    using Box = Eigen::AlignedBox2d;

    /// The map contains the bounds, walls, targets, robots and `extra` (m), with a margin. Its longer side
    /// has `pixels` pixels; its upper left corner is at (left, top).
    WorldMap(const bug::World& world, const Box& extra, double pixels, double left, double top);
    /// The map of an arena: in a world with start poses, it also contains the whole of each floor with a
    /// picture that ends at most 1.5 m from what is on the map.
    static WorldMap with_floors(const bug::World& world, double pixels);

    double width() const { return view_.sizes().x() * scale_; }   ///< pixels
    double height() const { return view_.sizes().y() * scale_; }  ///< pixels
    const Box& view() const { return view_; }                     ///< m
    double scale() const { return scale_; }                       ///< pixels per metre
    Axes axes() const;                                            ///< those of the whole map, in m
    double px(double x) const { return left_ + (x - view_.min().x()) * scale_; }
    double py(double y) const { return top_ + (view_.max().y() - y) * scale_; }

    void draw_floors(Canvas& canvas) const;
    void draw_ground(Canvas& canvas) const;  ///< floors, then static solids, from the lowest to the highest
    void draw_movable_objects(Canvas& canvas) const;  ///< draws them at their current poses
    void draw_marks(Canvas& canvas) const;            ///< bounds and start poses
    void draw_targets(Canvas& canvas) const;          ///< also draws the rings in which they count as reached
    /// Draws a robot and its gripper at the current pose, and its range scans if `rays` is set.
    void draw_robot(Canvas& canvas, std::size_t robot, bool rays) const;

  private:
    void draw_floor(Canvas& canvas, const bug::FloorSurface& floor) const;
    void draw_solid(Canvas& canvas, const bug::DrawnSolid& solid) const;
    void draw_rays(Canvas& canvas, std::size_t robot) const;

    const bug::World& world_;
    Box view_;
    double left_, top_, scale_;
};

/// The current state of a world as a picture with axes and the names of the robots.
Picture world_plot(const bug::World& world, const std::string& title);

}  // namespace forage::plot
