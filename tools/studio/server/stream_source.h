// Where the numbers of a stream come from: cells of groups, synapses, or the world.
#pragma once

#include <cstdint>
#include <memory>
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

/// Where the numbers of a stream come from.
class StreamSource {
  public:
    virtual ~StreamSource() = default;
    virtual std::uint32_t rows() const = 0;
    virtual std::uint32_t columns() const = 0;
    virtual std::string label() const = 0;
    virtual Type type() const { return Type::float32; }
    /// Reads rows() * columns() numbers as they are now.
    virtual void read(Run& run, std::span<double> out) const = 0;
    /// Adds to `demand` what is read.
    virtual void declare(engine::Demand&) const {}
};

/// The source that a page names: an expression of sources, "sampled(CONNECTION)" or
/// "sampled(CONNECTION:STATE)" for the synapses of a connection as a picture, or "world:poses",
/// "world:rays:ROBOT", "world:parts:ROBOT", "world:camera:ROBOT", "world:trail:ROBOT". Throws InputError.
std::unique_ptr<StreamSource> find_stream_source(Run& run, std::string_view text, Delivery delivery);

}  // namespace forage::studio
