#include "neurons/random_spike.h"

#include "neurons/membrane.h"

namespace forage {

void RandomSpike::update(NeuronColumns& c) const {
    auto [act] = c.states<1>();
    if (probability < 1)
        c.events(membrane::chance(probability), act, amplitude);
    else
        act = amplitude;
}

}  // namespace forage
