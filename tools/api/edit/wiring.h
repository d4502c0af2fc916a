// Which cells a connection joins, in plain words: the pattern that is meant by each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/system.h"

namespace forage::editing {

/// The wirings that wiring_pattern() knows: "one to one", "all to all" and "nearest".
const std::vector<std::string>& wirings();

/// The pattern of a wiring between two groups. "one to one" pairs the k-th cells of both; "nearest" pairs
/// each cell, of either group, with the cell at the same relative place of the other. "fitting" is "one to
/// one" between groups of the same shape, else "all to all", or "nearest" where that would be more than a
/// million pairs. Throws InputError for another word.
model::Pattern wiring_pattern(std::string_view wiring, const model::Topology& source,
                              const model::Topology& target);

/// The wiring of a connection: one of wirings(), "chosen cells" for other tuples, or "advanced".
std::string wiring_of(const model::Connection& connection, const model::Topology& source,
                      const model::Topology& target);

}  // namespace forage::editing
