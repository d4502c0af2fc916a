// What came of a robot's trials: a table, and a few lines for people.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "tools/forage/measures.h"

namespace forage::tool {

/// A trial and what was measured in it.
struct MeasuredTrial {
    Trial trial;
    TrialMeasures measures;
    std::string route;  ///< the patches that came into view, "cyan > red"
};

/// The trials of a robot: the finished ones and, if it had begun, the one that ran at the end.
struct Trials {
    std::vector<MeasuredTrial> finished;
    std::optional<MeasuredTrial> running;

    static constexpr std::size_t window = 50;  ///< trials over which the success ratio is taken

    std::size_t reached() const;
    /// Part of the last `window` of the first `count` finished trials (fewer at the start) that reached the
    /// target. `count` > 0.
    double recent_success(std::size_t count) const;
};
Trials trials_of(const bug::World& world, std::size_t robot, const Measures& measures,
                 const engine::Simulation& simulation);

/// A row per trial, in m and rad; what does not apply is left empty. docs/reference/results.md says what the
/// columns are.
std::string trials_csv(const Trials& trials);

/// Lines for people: what each one is about, and its text.
std::vector<std::pair<std::string, std::string>> trials_summary(const bug::World& world,
                                                                const Trials& trials);

}  // namespace forage::tool
