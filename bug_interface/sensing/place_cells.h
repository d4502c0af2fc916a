// Place cells and head direction cells.
#pragma once

#include <span>

namespace forage::bug {

/// The area that a group of place cells covers. The receptive fields have their centres in [-1, 1] x [-1, 1].
struct PlaceField {
    double x_offset = 0, y_offset = 0;  ///< centre of the area in the world, m
    double x_max = 10, y_max = 10;      ///< half the extents of the area, m
    double sigma = 0.2;                 ///< width of a receptive field, in units of x_max and y_max
};

/// Fills `out` with the activities of w x h place cells, row 0 at +y. The receptive field of cell (r, c) has
/// its centre at X = (c - w/2) / (w/2), Y = -(r - h/2) / (h/2), where w/2 and h/2 are rounded down; X or Y is
/// 0 when there is only one column or row. The activity is exp(-distance^2 / sigma^2), divided by the largest
/// activity in the group. (x, y) is the position of the robot, m.
void place_cells(double x, double y, int w, int h, const PlaceField& field, std::span<double> out);

/// Fills `out` with the activities of head direction cells. They cover a full turn: cell 0 is the direction
/// -x, followed by -y, +x and +y. The activity is exp(-(d / sigma)^2), divided by the largest activity in the
/// group; d is the difference of directions in turns, and `sigma` is in turns, too. `yaw` is the heading of
/// the robot, rad.
void head_direction_cells(double yaw, double sigma, std::span<double> out);

}  // namespace forage::bug
