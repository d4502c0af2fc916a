#include "neurons/neurons.h"

#include "neurons/integrate_fire.h"
#include "neurons/leaky_integrator.h"
#include "neurons/linear_threshold.h"
#include "neurons/numeric.h"
#include "neurons/pyramid_apical_shunt.h"
#include "neurons/random_spike.h"
#include "neurons/sigmoid.h"
#include "neurons/tanh.h"
#include "neurons/td_value.h"

namespace forage {

void add_neurons(Registry& registry) {
    registry.add(neuron_type<IntegrateFire>());
    registry.add(neuron_type<LeakyIntegrator>());
    registry.add(neuron_type<LinearThreshold>());
    registry.add(neuron_type<Numeric>());
    registry.add(neuron_type<PyramidApicalShunt>());
    registry.add(neuron_type<RandomSpike>());
    registry.add(neuron_type<Sigmoid>());
    registry.add(neuron_type<TanH>());
    registry.add(neuron_type<TDValue>());
}

}  // namespace forage
