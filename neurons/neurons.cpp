#include "neurons/neurons.h"

#include "neurons/linear_threshold.h"
#include "neurons/random_spike.h"

namespace forage {

void add_neurons(Registry& registry) {
    registry.add(neuron_type<LinearThreshold>());
    registry.add(neuron_type<RandomSpike>());
}

}  // namespace forage
