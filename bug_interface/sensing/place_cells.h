// Cells that know where the robot is and where it looks.
#pragma once

#include <span>

namespace forage::bug {

/// Where the fields of a group of place cells lie. A cell's field is at a point of [-1, 1] x [-1, 1].
struct PlaceField {
    double x_offset = 0, y_offset = 0;  ///< m; the world point that the middle of the group stands for
    double x_max = 10, y_max = 10;      ///< m; distance from there to the edge of the group
    double sigma = 0.2;                 ///< width of a field, in units of x_max and y_max
};

/// out: w x h cells, row 0 is +y. Cell (r, c) stands for X = (c - w/2) / (w/2), Y = -(r - h/2) / (h/2),
/// halves rounded down (a side of one cell stands for 0); its activity is exp(-distance^2 / sigma^2), divided
/// by the greatest of the group. x, y: the robot, m.
void place_cells(double x, double y, int w, int h, const PlaceField& field, std::span<double> out);

/// One row of cells round the circle: cell 0 is -x, then -y, +x, +y. Activity exp(-(d / sigma)^2) over the
/// greatest of the group; d is the distance on a circle of circumference 1. yaw: rad.
void head_direction_cells(double yaw, double sigma, std::span<double> out);

}  // namespace forage::bug
