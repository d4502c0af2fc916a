// What several neuron types share: parameters of the membrane and the random mask.
#pragma once

#include "core/types/neuron.h"

namespace forage::membrane {

/// Declares gains, persistence and clipping of a type with the members exc_gain, inh_gain, persistence, clip,
/// minimum and maximum.
template <class T>
void describe_potential(NeuronSpec<T>& s) {
    s.reads(InputKind::excitatory, InputKind::inhibitory);
    s.param("excGain", &T::exc_gain)
        .label("Excitatory gain")
        .range(0, 10)
        .doc("Gain of the summed excitation.");
    s.param("inhGain", &T::inh_gain)
        .label("Inhibitory gain")
        .range(0, 10)
        .doc("Gain of the summed inhibition.");
    s.param("vmPrs", &T::persistence)
        .label("Membrane persistence")
        .range(0, 1)
        .doc("Part of vm kept per cycle.");
    s.param("clipVm", &T::clip).label("Clip potential").doc("Keep vm between vmMin and vmMax.");
    s.param("vmMin", &T::minimum).label("Minimum potential").range(0, 1).doc("Lowest vm when it is clipped.");
    s.param("vmMax", &T::maximum)
        .label("Maximum potential")
        .range(0, 1)
        .doc("Highest vm when it is clipped.");
}

/// Declares probability and threshold.
template <class T>
void describe_firing(NeuronSpec<T>& s) {
    s.param("probability", &T::probability)
        .label("Probability")
        .range(0, 1)
        .doc("Chance per cycle that a cell is active.");
    s.param("threshold", &T::threshold)
        .label("Threshold potential")
        .range(0, 1)
        .doc("Potential below which act is 0.");
}

/// Finds clipping between bounds that are the wrong way round: then vm is always the maximum.
template <class T>
void check_bounds(const T& p, Problems& problems) {
    if (p.clip && p.minimum > p.maximum)
        problems.all.push_back(
            {"vmMin is above vmMax: the potential is always vmMax", "exchange them", "vmMin", {}});
}

/// vm = ((vm * vmPrs) + exc * excGain) - inh * inhGain, then clipped from below and from above if asked;
/// `previous` is the potential that persists. NaN passes.
template <class T, class Previous>
void integrate(const T& p, const NeuronColumns& c, Column& vm, const Previous& previous) {
    Column exc = c.excitation(), inh = c.inhibition();
    exc *= p.exc_gain;
    inh *= p.inh_gain;
    vm = (previous * p.persistence + exc) - inh;
    if (p.clip) {
        vm = (vm < p.minimum).select(p.minimum, vm);
        vm = (vm > p.maximum).select(p.maximum, vm);
    }
}

/// Multiplies `act` by 0 in the cells that stay silent in this cycle. Draws nothing when the probability
/// is 1.
inline void silence(const NeuronColumns& c, Column& act, double probability) {
    if (probability < 1)
        act *= (c.uniform() * 0.99999999 < 1 - probability).select(0.0, Eigen::ArrayXd::Ones(c.size()));
}

}  // namespace forage::membrane
