// Where the numbers of a stream come from: cells of groups, synapses, or the world.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/observe/observer.h"
#include "core/run/run.h"

namespace forage::studio {

/// The types of numbers in a frame, as docs/design/studio-protocol.md numbers them.
enum class Type : std::uint8_t { float32, float64, uint8 };

/// Whether a page gets the newest numbers only, or every cycle.
enum class Delivery { latest, append };

/// The numbers of a stream, row by row.
struct StreamSource {
    std::uint32_t rows, columns;
    std::string label;
    /// Reads rows * columns numbers as they are now.
    std::function<void(Run& run, std::span<double> out)> read = {};
    Type type = Type::float32;
    engine::Demand demand = {};  ///< what is read of the run
};

/// The source that a page names: an expression of sources, "sampled(CONNECTION)" or
/// "sampled(CONNECTION:STATE)" for the synapses of a connection as a picture, or "world:poses",
/// "world:rays:ROBOT", "world:parts:ROBOT", "world:camera:ROBOT", "world:trail:ROBOT". Throws InputError.
StreamSource find_stream_source(Run& run, std::string_view text, Delivery delivery);

}  // namespace forage::studio
