#include "neurons/pyramid_apical_shunt.h"

namespace forage {

void PyramidApicalShunt::update(NeuronColumns& c) const {
    auto [vm, act, shunt, backprop] = c.states<4>();
    vm = (vm * persistence + c.excitation()) - c.inhibition();
    act = (vm < threshold).select(0.0, Eigen::ArrayXd::Ones(c.size()));
    vm -= act * reset;
    backprop = c.past(1, 1);
    shunt = 1 / (1 - c.modulation());
}

}  // namespace forage
