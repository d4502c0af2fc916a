// The weights of a connection as a matrix that a page can draw, however many there are.
#pragma once

#include <string_view>

#include "tools/studio/server/stream_source.h"

namespace forage::studio {

/// A matrix of at most 256 x 256 numbers, with a row for each target cell or block of them, and a column for
/// each source cell or block: the mean of the synapses between both, NaN without any. `text` is
/// "CONNECTION:state", or "CONNECTION" for weights of the file that no type changes. Throws InputError.
StreamSource sampled_synapses(Run& run, std::string_view text);

}  // namespace forage::studio
