// The forms of connections. Each is a file of its own; all give the bits of the list.
#pragma once

#include "core/base/array.h"
#include "core/connectivity/connect.h"
#include "core/connectivity/regular.h"
#include "core/engine/kernels/kernel.h"

namespace forage::engine {

/// Synapses sorted by target; those of one target stay in synapse order.
struct ByTarget {
    std::vector<int> start;  ///< of target t's synapses; one more entry than targets
    std::vector<int> pre, delay;
    std::vector<double> factor;  ///< reference - attenuation

    std::size_t targets() const { return start.size() - 1; }
};
/// Sorts synapses by target. Frees the parts of `synapses` once they are copied.
ByTarget sort_by_target(connectivity::Synapses synapses, int target_cells);

enum class Forms {
    fastest,  ///< the cheapest form that fits
    general,  ///< always the list of synapses: what the other forms are tested against
};

/// Makes a kernel for synapses that multiply by a constant: psp = (gain * pre) * factor, rounded in this
/// order.
std::unique_ptr<Kernel> make_kernel(connectivity::Synapses synapses, GroupShape source, GroupShape target,
                                    Forms forms);
/// Makes a kernel for a connection that is the same everywhere, and whose synapses multiply by a constant.
std::unique_ptr<Kernel> make_kernel(const connectivity::Regular& regular, int target_cells);
/// Whether a matrix of weights (targets x sources) has so many numbers that no list of synapses is needed.
bool fits_matrix(const Array& weights, GroupShape target);
/// Makes a kernel for such a matrix.
std::unique_ptr<Kernel> make_kernel(const Array& weights, GroupShape source, GroupShape target, int delay);
/// Makes a kernel for synapses with an update(), and reserves room for their states. `reads_states` says that
/// PlasticKernel::state() will be called.
std::unique_ptr<PlasticKernel> make_plastic(connectivity::Synapses synapses, GroupShape source,
                                            GroupShape target, const SynapseType& type, bool reads_states,
                                            Rows& rows, Forms forms);

// Each of these functions makes one form. Those that take synapses by reference return null when the form
// does not fit.

std::unique_ptr<Kernel> make_one_to_one(int cells, int delay, double factor);
std::unique_ptr<Kernel> make_one_to_one(const ByTarget& synapses, int source_cells);
/// `targets` are the cells with synapses; when it is empty, all have them.
std::unique_ptr<Kernel> make_broadcast(ByTarget synapses_of_one, int target_cells,
                                       std::vector<int> targets = {});
std::unique_ptr<Kernel> make_broadcast(const ByTarget& synapses);
std::unique_ptr<Kernel> make_window(const connectivity::Regular& window);
std::unique_ptr<Kernel> make_by_source(const ByTarget& synapses, GroupShape source, GroupShape target);
std::unique_ptr<Kernel> make_sliced(const ByTarget& synapses, int source_cells);
std::unique_ptr<Kernel> make_list(ByTarget synapses);
std::unique_ptr<PlasticKernel> make_plastic_by_source(const connectivity::Synapses& synapses,
                                                      GroupShape source, GroupShape target,
                                                      const SynapseType& type, bool reads_states, Rows& rows);
std::unique_ptr<PlasticKernel> make_plastic_list(connectivity::Synapses synapses, int target_cells,
                                                 const SynapseType& type, Rows& rows);

}  // namespace forage::engine
