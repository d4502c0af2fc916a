// The names of the tables about robots among the results of a run.
#pragma once

#include <string>
#include <string_view>

namespace forage {

/// The table of trials. `suffix` tells the robots of a world with several from each other; an experiment has
/// one for all its runs.
inline std::string trials_file(const std::string& suffix = {}) { return "trials" + suffix + ".csv"; }
/// The table of the path of a robot; `suffix` as in trials_file().
inline std::string trajectory_file(const std::string& suffix = {}) { return "trajectory" + suffix + ".csv"; }

/// Whether a file with this name is a table of trials, or of a path, of any robot.
inline bool is_of_trials(std::string_view name) { return name.starts_with("trials"); }
inline bool is_of_trajectory(std::string_view name) { return name.starts_with("trajectory"); }

}  // namespace forage
