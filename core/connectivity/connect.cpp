#include "core/connectivity/connect.h"

#include <cmath>

#include <fmt/format.h>

#include "core/connectivity/arbor.h"
#include "core/connectivity/distance_functions.h"
#include "core/connectivity/pairs.h"

namespace forage::connectivity {

Synapses connect(const model::Connection& connection, const model::Topology& source_topology,
                 const model::Topology& target_topology, std::uint64_t seed, Diagnostics& diagnostics,
                 double most) {
    enum Stream : std::uint32_t { arbor_stream, attenuation_stream, delay_stream };
    for (const auto* topology : {&source_topology, &target_topology}) {
        const GroupShape size = model::shape(*topology);
        if (static_cast<double>(size.width) * size.height > static_cast<double>(model::max_extent)) {
            diagnostics.error(connection.at,
                              fmt::format("connection '{}' joins a group that is too large: {} x {} cells",
                                          connection.name, size.width, size.height));
            return {};
        }
    }
    const Grid source(source_topology), target(target_topology);
    const bool receptive = connection.arborization.direction == model::Direction::receptive;
    Arbor arbor(connection.arborization, receptive ? source : target,
                RandomStream(seed, connection.id, arbor_stream));

    Synapses out;
    const double points = arbor.max_points(), pairs = most_pairs(connection.pattern, source, target);
    if (pairs * points > most) {
        diagnostics.error(
            connection.at,
            fmt::format("connection '{}' is too large: {:.4g} pairs of cells with up to {:.4g} points each",
                        connection.name, pairs, points),
            fmt::format("a connection has at most {:.4g} synapses; use smaller groups, a PatternMapped or a "
                        "smaller arborization",
                        most));
        return out;
    }
    const int errors_before = diagnostics.errors();
    std::size_t paired = 0;
    for_each_pair(
        connection.pattern, source, target,
        [&](Place s, Place t) {
            const Place& fixed =
                receptive ? t : s;  // the side without arborization: the nearest cell, halves to even
            const int cell = (receptive ? target : source)
                                 .index(static_cast<int>(std::nearbyint(fixed.x)),
                                        static_cast<int>(std::nearbyint(fixed.y)));
            if (cell < 0) return;
            ++paired;
            arbor.spread(receptive ? s : t, [&](int spread_cell, double distance) {
                out.pre.push_back(receptive ? spread_cell : cell);
                out.post.push_back(receptive ? cell : spread_cell);
                out.distance.push_back(distance);
            });
        },
        diagnostics);
    if (out.size() == 0) {
        if (diagnostics.errors() > errors_before) return out;  // the reason was reported
        diagnostics.error(paired ? connection.arborization.at : connection.at,
                          fmt::format("connection '{}' has no synapses", connection.name),
                          paired ? "its pattern pairs cells, but its arborization (count, window, "
                                   "probability) leaves none of their synapses"
                                 : "its pattern pairs no cell of the source with a cell of the target");
        return out;
    }
    auto attenuated = attenuation(connection.attenuation, out.distance,
                                  RandomStream(seed, connection.id, attenuation_stream));
    out.attenuation = std::move(attenuated.values);
    out.reference = attenuated.reference;
    out.delay = delays(connection.delay, out.distance, RandomStream(seed, connection.id, delay_stream));
    for (const double a : out.attenuation)
        if (std::isnan(a)) {
            diagnostics.warning(
                connection.attenuation.at,
                fmt::format("the attenuation of connection '{}' is not a number: 0 / 0", connection.name),
                "FunLinear divides by the largest distance, and here all distances are 0; use FunUniform");
            break;
        }
    return out;
}

}  // namespace forage::connectivity
