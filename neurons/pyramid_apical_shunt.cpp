#include "neurons/pyramid_apical_shunt.h"

namespace forage {

void PyramidApicalShunt::update(NeuronColumns& c) const {
    auto [vm, act, shunt, backprop] = c.states<4>();
    vm = (vm * persistence + c.excitation()) - c.inhibition();
    act = (vm >= threshold).select(Eigen::ArrayXd::Ones(c.size()), 0.0);  // NaN is silent
    vm -= act * reset;
    backprop = c.past(1, 1);
    shunt = 1 / (1 - c.modulation());
}

}  // namespace forage
