#include "synapses/synapses.h"

#include "synapses/apical_shunt.h"
#include "synapses/fixed_weight.h"
#include "synapses/hebbian.h"
#include "synapses/test_synapse.h"
#include "synapses/uniform_fixed_weight.h"

namespace forage {

void add_synapses(Registry& registry) {
    registry.add(synapse_type<ApicalShunt>());
    registry.add(synapse_type<FixedWeight>());
    registry.add(synapse_type<Hebbian>());
    registry.add(synapse_type<TestSynapse>());
    registry.add(synapse_type<UniformFixedWeight>());
}

}  // namespace forage
