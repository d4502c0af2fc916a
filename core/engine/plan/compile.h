// From a model to a plan, and the state in which a run begins.
#pragma once

#include "core/engine/kernels/forms.h"
#include "core/engine/options.h"
#include "core/engine/plan/demand.h"
#include "core/engine/plan/plan.h"
#include "core/engine/state.h"

namespace forage::engine {

/// The most bytes that the numbers of a system may take: 16 GiB. Lists of synapses come on top.
inline constexpr double max_bytes = 16.0 * (1 << 30);

struct Compiled {
    std::shared_ptr<const Plan> plan;
    std::unique_ptr<State> state;
};

/// Compiles a system for a demand; `layout` is that of the system. The result is empty when `diagnostics` got
/// an error, for example because the system needs more than `max_bytes` or more memory than there is.
Compiled compile(const model::System& system, std::shared_ptr<const Layout> layout, const Demand& demand,
                 const Options& options, Diagnostics& diagnostics);

/// What a demand does not need: groups and connections by their numbers, outputs by module and port.
struct Pruned {
    std::vector<bool> groups, connections;
    std::vector<std::vector<bool>> outputs;
};

/// Finds the groups on which neither the demand nor an input of a module depends.
Pruned prune(const Layout& layout, const Demand& demand);

/// Orders the updates and deliveries of a cycle: sets Plan::steps and Plan::late.
void order_steps(Plan& plan);

}  // namespace forage::engine
