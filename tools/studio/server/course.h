// A run with its past, which can be repeated.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/run/run.h"
#include "core/run/run_spec.h"
#include "tools/api/open/sources.h"
#include "tools/studio/server/history.h"
#include "tools/studio/server/page_manipulations.h"

namespace forage::studio {

/// A parameter that was set.
struct Change {
    std::string assignment;
    nlohmann::json loaded;  ///< the value of the file
};
using Changes = std::map<std::string, Change>;  ///< by the name of the parameter

/// A run, the manipulations in it, its past, and the parameters that were set.
struct Course {
    std::unique_ptr<Run> run;
    PageManipulations* manipulations = nullptr;
    History history;
    Changes changed;

    /// Repeats the actions that the history has before the next cycle.
    void repeat_actions();
    /// Repeats these actions, computes a cycle, and makes a checkpoint when one is due.
    void step();
    /// Restores the last checkpoint at or before `cycle`, and repeats the past from there to `cycle`.
    void replay(std::uint64_t cycle);
    /// A course that can repeat this one from its beginning or from the last checkpoint before `cycle`; its
    /// run is still missing.
    Course past(std::uint64_t cycle);
    /// Takes the run of a course without a past.
    void take_run(Course&& built);
};

/// Builds and starts a run of a system that names no file that a page may not name. Empty when `diagnostics`
/// has an error.
std::optional<Course> build_run(const Sources& sources, const RunInput& input, std::uint64_t seed,
                                Diagnostics& diagnostics);
/// Reads the files of a run, builds it and starts it. `digest` becomes that of the files. Throws InputError.
Course open_run(const RunInput& input, std::string* digest = nullptr);

}  // namespace forage::studio
