// Warnings about connections that most likely do not say what was meant.
#pragma once

#include "core/connectivity/connect.h"

namespace forage::connectivity {

/// Warns, at most once per connection, of a projection between two whole groups that leaves cells out
/// although the file does not say type="center", of a PatternForeach with ArbAll, which joins each pair
/// several times, and of pairs that tuples repeat. What may be meant gives no warning: an arborization
/// chooses the cells around a pair, and a single source cell leads to the middle of its target.
void warn_of_wiring(const model::Connection& connection, const model::Group& source,
                    const model::Group& target, const Synapses& synapses, Diagnostics& diagnostics);

}  // namespace forage::connectivity
