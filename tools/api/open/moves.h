// What a person does to the world of a run between two cycles, now or on a schedule.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "bug_interface/simulation/world.h"
#include "core/observe/schedule.h"
#include "core/run/run.h"

namespace forage {

/// The world of a run. Throws InputError when it has none.
bug::World& world_of(Run& run);
/// The number of the robot with this name, from 0; of the first one for an empty name. Throws InputError.
std::size_t find_robot(Run& run, std::string_view name);

/// Moves the robot or the movable object with this name to a place, m, where it is at rest. It turns to
/// `heading`, rad to the left of the x axis, or keeps its own. Throws InputError for an unknown name, for a
/// place more than 10 km away, when something is there, and while the robot is being reset.
void move(Run& run, std::string_view name, double x, double y, std::optional<double> heading = {});
/// Ends the trial of a robot, and begins the next one at the start pose with this number, from 0, or at the
/// next one. The robot is the first one for an empty name. Throws InputError.
void begin_trial(Run& run, std::string_view robot = {}, std::optional<std::size_t> start = {});
/// Whether a finished trial was ended by a time limit or by begin_trial(), not because the robot left the
/// bounds or, where the world's rules say so, reached a target.
bool truncated(Run& run, const Trial& trial);

/// Reads "move NAME=X,Y[,HEADING]" and "begin_trial [ROBOT][=START]" for a schedule, with the meaning of
/// these functions: places in m, headings in rad, starts from 0. Reports names that the world of this run
/// does not have.
observe::ReadAction actions_on(Run& run);

}  // namespace forage
