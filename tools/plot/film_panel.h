// What stands beside the map of a film: the time, the score, and what the robots see.
#pragma once

#include <algorithm>

#include "bug_interface/simulation/world.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

inline constexpr double panel_width = 270;  ///< pixels

/// Camera picture and ray sensors of one robot; the same smaller for up to four, the pictures for up to
/// eight.
class FilmPanel {
  public:
    /// The world must outlive it.
    explicit FilmPanel(bug::World& world) : world_(world) {}

    double height() const;  ///< pixels, at most
    /// The world as it is now, below and to the right of (x, y).
    void draw(Canvas& canvas, double x, double y);

  private:
    std::size_t escaped() const { return std::min(world_.bugs(), std::size_t{8}); }
    bool single() const { return world_.bugs() == 1; }
    double part_width() const { return single() ? panel_width : (panel_width - 10) / 2; }
    double part_height() const;
    void draw_clock(Canvas& canvas, double x, double y);
    void draw_picture(Canvas& canvas, std::size_t robot, double x, double y);
    void draw_rays(Canvas& canvas, std::size_t robot, double x, double y);

    bug::World& world_;
};

}  // namespace forage::plot
