#include "core/connectivity/connect.h"

#include <fmt/format.h>

#include <cmath>

#include "core/connectivity/arbor.h"
#include "core/connectivity/distance_functions.h"
#include "core/connectivity/pairs.h"

namespace forage::connectivity {

Synapses connect(const model::Connection& connection, const model::Topology& source_topology,
                 const model::Topology& target_topology, std::uint64_t seed, Diagnostics& diagnostics) {
    enum Stream : std::uint32_t { arbor_stream, attenuation_stream, delay_stream };
    const Grid source(source_topology), target(target_topology);
    const bool receptive = connection.arborization.direction == model::Direction::receptive;
    Arbor arbor(connection.arborization, receptive ? source : target, RandomStream(seed, connection.id, arbor_stream));

    Synapses out;
    for_each_pair(
        connection.pattern, source, target,
        [&](Place s, Place t) {
            const Place& fixed = receptive ? t : s;  // the side that is not spread: the nearest cell, half to even
            const int cell = (receptive ? target : source).index(static_cast<int>(std::nearbyint(fixed.x)), static_cast<int>(std::nearbyint(fixed.y)));
            if (cell < 0) return;
            arbor.spread(receptive ? s : t, [&](int spread_cell, double distance) {
                out.pre.push_back(receptive ? spread_cell : cell);
                out.post.push_back(receptive ? cell : spread_cell);
                out.distance.push_back(distance);
            });
        },
        diagnostics);
    if (out.size() == 0) {
        diagnostics.error(connection.at, fmt::format("connection '{}' has no synapses", connection.name),
                          "its pattern and arborization reach no cell of the source or of the target");
        return out;
    }
    auto attenuated = attenuation(connection.attenuation, out.distance, RandomStream(seed, connection.id, attenuation_stream));
    out.attenuation = std::move(attenuated.values);
    out.reference = attenuated.reference;
    out.delay = delays(connection.delay, out.distance, RandomStream(seed, connection.id, delay_stream));
    for (const double a : out.attenuation)
        if (std::isnan(a)) {
            diagnostics.warning(connection.attenuation.at,
                                fmt::format("the attenuation of connection '{}' is not a number: 0 / 0", connection.name),
                                "FunLinear divides by the largest distance, and here all distances are 0; use FunUniform");
            break;
        }
    return out;
}

}  // namespace forage::connectivity
