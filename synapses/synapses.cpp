#include "synapses/synapses.h"

#include "synapses/fixed_weight.h"

namespace forage {

void add_synapses(Registry& registry) { registry.add(synapse_type<FixedWeight>()); }

}  // namespace forage
