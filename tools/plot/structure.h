// Pictures of the structure of a system.
#pragma once

#include <string>
#include <string_view>

#include "core/connectivity/connect.h"
#include "core/engine/simulation.h"
#include "core/model/system.h"
#include "tools/plot/canvas.h"
#include "tools/plot/plot_spec.h"
#include "tools/plot/wiring.h"

namespace forage::plot {

/// Reports an unknown process or connection of a picture.
void check_structure(const PlotSpec& spec, const model::System& system, std::string_view option,
                     Diagnostics& diagnostics, Location at = {});

/// The connection with this name or id. Reports an error and returns null when there is none, or several with
/// this name.
const model::Connection* find_connection(const model::System& system, std::string_view name,
                                         std::string_view option, Diagnostics& diagnostics, Location at = {});

/// The synapses of a connection, in the order of their sums.
struct ConnectionSynapses {
    connectivity::Synapses list;
    std::vector<double> strength;  ///< the input that each of them delivers for an activity of 1
};
/// Builds the synapses of a connection. Weights that are learned are those in `simulation`, which is compiled
/// from the same system with the same seed; without one they are 0. Reports what is wrong with the
/// connection.
ConnectionSynapses synapses_of(const model::Connection& connection, const model::System& system,
                               const Registry& registry, const engine::Simulation* simulation,
                               std::uint64_t seed, Diagnostics& diagnostics);

/// The groups of a connection that check_structure() has accepted, without synapses. Throws
/// std::runtime_error.
WiringPlot wiring_of(const PlotSpec& spec, const model::System& system);

/// The picture of a diagram or a connection that check_structure() has accepted. A connection plot shows the
/// strengths in the file; for plastic synapses those of `simulation`, or 0 when it is null. `run` is the
/// subtitle. Throws std::runtime_error.
Picture structure_plot(const PlotSpec& spec, const model::System& system, const Registry& registry,
                       const engine::Simulation* simulation, std::uint64_t seed, const std::string& run);

}  // namespace forage::plot
