#include "neurons/random_spike.h"

#include "neurons/membrane.h"

namespace forage {

void RandomSpike::update(NeuronColumns& c) const {
    auto [act] = c.states<1>();
    act.setConstant(amplitude);
    membrane::silence(c, act, probability);
}

}  // namespace forage
