#include "core/engine/kernels/plastic_kernel.h"

#include "core/engine/kernels/plastic_by_source.h"
#include "core/engine/kernels/plastic_list.h"

namespace forage::engine {

std::unique_ptr<PlasticKernel> make_plastic(connectivity::Synapses synapses, int source_cells,
                                            int target_cells, const SynapseType& type,
                                            const SynapseInstance& synapse, Arena& arena, Forms forms) {
    if (forms == Forms::fastest && type.event_driven)
        if (const auto order = order_of_sources(synapses, source_cells, target_cells); !order.sources.empty())
            return std::make_unique<PlasticBySource>(std::move(synapses), order, source_cells, target_cells,
                                                     type, synapse, arena);
    return std::make_unique<PlasticList>(std::move(synapses), target_cells, type, synapse, arena);
}

}  // namespace forage::engine
