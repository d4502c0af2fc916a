// The panel beside the map of a film: the time, the score, and what the robots sense.
#pragma once

#include <algorithm>

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

inline constexpr double panel_width = 270;  ///< pixels

/// Shows the camera picture and the ray sensors of one robot, a smaller version of both for up to four
/// robots, and only the pictures for up to eight.
class FilmPanel {
  public:
    /// `world` must outlive the panel.
    explicit FilmPanel(bug::World& world) : world_(world) {}

    double height() const;  ///< maximum height, pixels
    /// Draws what is the same in all frames: names. (x, y) is the upper left corner.
    void draw_names(Canvas& canvas, double x, double y);
    /// Draws the current state of the world, in the same place.
    void draw(Canvas& canvas, double x, double y);

  private:
    std::size_t robots_shown() const { return std::min(world_.bugs(), std::size_t{8}); }
    bool single() const { return world_.bugs() == 1; }
    double part_width() const { return single() ? panel_width : (panel_width - 10) / 2; }
    double part_height() const;
    /// Calls `draw` for each robot with its number and its upper left corner.
    template <class Draw>
    void for_each_robot(double x, double y, Draw draw);
    /// Calls `draw` for each ray sensor of a robot with its name, cells, colour, and the upper edge of its
    /// bars.
    template <class Draw>
    void for_each_ray_sensor(std::size_t robot, double y, Draw draw);
    void draw_clock(Canvas& canvas, double x, double y);
    void draw_picture(Canvas& canvas, std::size_t robot, double x, double y);

    bug::World& world_;
};

}  // namespace forage::plot
