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
    /// Draws the current state of the world. (x, y) is the upper left corner.
    void draw(Canvas& canvas, double x, double y);

  private:
    std::size_t robots_shown() const { return std::min(world_.bugs(), std::size_t{8}); }
    bool single() const { return world_.bugs() == 1; }
    double part_width() const { return single() ? panel_width : (panel_width - 10) / 2; }
    double part_height() const;
    void draw_clock(Canvas& canvas, double x, double y);
    void draw_picture(Canvas& canvas, std::size_t robot, double x, double y);
    void draw_rays(Canvas& canvas, std::size_t robot, double x, double y);

    bug::World& world_;
};

}  // namespace forage::plot
