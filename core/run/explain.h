// Why does it do nothing? Explains the activity of a system from its wiring and from what a run has shown.
#pragma once

#include <string>
#include <vector>

#include "core/model/system.h"
#include "core/observe/group_statistics.h"

namespace forage {

/// Returns what is probably a mistake in a valid system, as far as that is known without running it: disabled
/// modules, groups that nothing drives or reads, inputs that a type does not read. One sentence each.
std::vector<std::string> wiring_notes(const model::System& system, const engine::Layout& layout);

/// Returns a table of the mean, least and largest value and the share of active cells of every group's
/// activity and inputs over a run, for a terminal.
std::string activity_table(const engine::Layout& layout, const observe::GroupStatistics& statistics);

/// Returns wiring_notes(), and why groups were silent or clipped in a run, one sentence each. For a group
/// that was silent although an enabled module reads it, such as a motor group, the sentence follows the
/// silence back to the first silent group.
std::vector<std::string> explanation(const model::System& system, const engine::Layout& layout,
                                     const observe::GroupStatistics& statistics);

}  // namespace forage
