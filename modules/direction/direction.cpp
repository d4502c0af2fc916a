#include "modules/direction/direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace forage::goal {
namespace {

enum In : std::size_t { location_in, orientation_in, goal_in };
enum Out : std::size_t { direction_out, distance_out };

double up(const GridPosition& from, const GridPosition& to) { return static_cast<double>(from.row - to.row); }
double left(const GridPosition& from, const GridPosition& to) {
    return static_cast<double>(from.column - to.column);
}

}  // namespace

double distance(const GridPosition& from, const GridPosition& to) {
    const double rows = up(from, to), columns = left(from, to);
    return std::sqrt(rows * rows + columns * columns);
}

double bearing(const GridPosition& from, const GridPosition& to) {
    constexpr double pi = std::numbers::pi;
    double angle = std::atan(up(from, to) / left(from, to));  // division by 0 gives a right angle
    if (to.column > from.column)
        angle += pi;
    else if (to.row > from.row)
        angle += 2 * pi;
    return 1 - angle / (2 * pi);
}

double turn(double bearing, double orientation) {
    const double ahead = bearing - orientation;
    const double angle = std::min(std::abs(ahead), 1 - std::abs(ahead));
    const double step = angle < 0.05 ? 0 : angle < 0.1 ? 0.1 : angle < 0.15 ? 0.33 : 0.45;
    const bool forwards = (ahead > 0 && ahead <= 0.5) || ahead < -0.5;
    return forwards ? 0.5 + step : 0.5 - step;
}

void DirectionModule::describe(ModuleSpec<DirectionModule>& s) {
    s.name("directionModule", "Goal direction").doc("Shows the turn towards the goal, and its distance.");
    s.param("_sigma", &DirectionModule::sigma).label("Sigma").doc("Has no effect, as in the original.");
    s.input("_location", "Current location")
        .full_rectangle()
        .doc("The most active cell is the current location.");
    s.input("_ori", "Current orientation")
        .size("at least 2 cells, which cover a full turn",
              [](const auto&, PortSizes&, const GroupShape& given) {
                  return given.cells >= 2 ? given : rectangle(2, 1);
              })
        .doc("The most active cell is the orientation, as in a group of head direction cells.");
    s.input("_goal", "Goal location").same_size_as("_location").doc("The most active cell is the goal.");
    s.output("_dir", "Goal direction")
        .doc("1 at the turn towards the goal, 0 elsewhere; the middle stands for straight ahead.");
    s.output("_dist", "Goal distance")
        .cells(1)
        .tolerate([](PortSizes&, const GroupShape&) { return true; })
        .doc("The distance to the goal in cells; other cells stay 0.");
}

void DirectionModule::update(ModuleFrame& frame) const {
    frame.output(direction_out).setZero();
    frame.output(distance_out).setZero();
    const auto location = peak_position(frame.input(location_in), width_),
               goal = peak_position(frame.input(goal_in), width_);
    if (!location || !goal) return;
    const auto& cells = frame.input(orientation_in);
    const double orientation =
        static_cast<double>(highest_cell(cells)) / static_cast<double>(cells.size() - 1);
    const double s = turn(bearing(*location, *goal), orientation);
    Column direction = frame.output(direction_out);
    direction[static_cast<Index>((1 - s) * static_cast<double>(direction.size()))] = 1;
    frame.output(distance_out)[0] = distance(*location, *goal);
}

}  // namespace forage::goal
