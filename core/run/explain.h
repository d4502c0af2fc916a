// Why does it do nothing? Explains the activity of a system from its wiring and from what a run has shown.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/model/system.h"
#include "core/run/prepared_run.h"

namespace forage {

/// Returns what is probably a mistake in a valid system, as far as that is known without running it: disabled
/// modules, groups that nothing drives or reads, inputs that a type does not read. One sentence each.
/// `manipulated` are the numbers of groups whose activity a run changes: they need no other drive.
std::vector<std::string> wiring_notes(const model::System& system, const engine::Layout& layout,
                                      const std::set<int>& manipulated = {});

/// A group that an enabled module reads although nothing drives it, and a sentence that says so.
struct UndrivenInput {
    int group;
    std::string text;
};
std::vector<UndrivenInput> undriven_inputs(const model::System& system, const engine::Layout& layout,
                                           const std::set<int>& manipulated = {});

/// A robot that no module drives, and a sentence that says so.
struct UndrivenRobot {
    std::string robot, text;
};
/// The robots of a run that has started, if none of them is driven: one of several may be meant to stand.
std::vector<UndrivenRobot> undriven_robots(const Run& run);

/// Returns a table of the mean, least and largest value and the share of active cells of every group's
/// activity and inputs over a run, for a terminal.
std::string activity_table(const engine::Layout& layout, const observe::GroupStatistics& statistics);

/// Explains a run that was prepared with RunSpec::explain, one sentence each: what drove its robots,
/// wiring_notes(), and why groups were silent or clipped. For a group that was silent although an enabled
/// module reads it, such as a motor group, sentences follow the silence back to every group where it begins.
std::vector<std::string> explanation(const PreparedRun& prepared);

}  // namespace forage
