// Pictures of what a system is, rather than of what it does.
#pragma once

#include <string>
#include <string_view>

#include "core/engine/simulation.h"
#include "core/model/system.h"
#include "tools/plot/plot_spec.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// Reports a diagram's process or a connection that is not there.
void check_structure(const PlotSpec& wish, const model::System& system, std::string_view option,
                     Diagnostics& diagnostics, Location at = {});

/// The connection of this name or id; null when there is none, or several of that name, which is reported.
const model::Connection* find_connection(const model::System& system, std::string_view name,
                                         std::string_view option, Diagnostics& diagnostics, Location at = {});

/// The picture of a diagram or a connection that check_structure() has passed. A connection shows the
/// strengths that the file gives; where synapses learn, those of `simulation`, or 0 without one. `run` says
/// what it belongs to. Throws std::runtime_error.
Picture structure_plot(const PlotSpec& wish, const model::System& system, const Registry& registry,
                             const engine::Simulation* simulation, std::uint64_t seed,
                             const std::string& run);

}  // namespace forage::plot
