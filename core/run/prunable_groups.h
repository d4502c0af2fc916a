// What a run computes only because everything is demanded.
#pragma once

#include <cstddef>
#include <span>

#include "core/run/run.h"

namespace forage {

/// Counts the groups on which no observer and no module of a run depends, and none of the groups with the
/// numbers in `read`: a run without Run::Options::compute_everything would prune them. Returns 0 for such a
/// run.
std::size_t prunable_groups(Run& run, std::span<const int> read);

}  // namespace forage
