// What several neuron types share: parameters of the membrane and the random mask.
#pragma once

#include <limits>

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

/// What integrate() needs of a type and of one cycle.
struct Potential {
    double exc_gain, inh_gain, persistence;
    double minimum, maximum;  ///< infinite: not clipped
    double *exc, *inh;        ///< of all cells; null: silent
};

template <class T>
Potential potential(const T& p, const NeuronColumns& c) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {p.exc_gain,
            p.inh_gain,
            p.persistence,
            p.clip ? p.minimum : -infinity,
            p.clip ? p.maximum : infinity,
            c.silent(InputKind::excitatory) ? nullptr : c.excitation().data(),
            c.silent(InputKind::inhibitory) ? nullptr : c.inhibition().data()};
}

/// vm = ((vm * vmPrs) + exc * excGain) - inh * inhGain, then clipped from below and from above if asked, for
/// `cells` cells from `first` on; `previous` is the potential that persists. The columns are those of all
/// cells. NaN passes. Leaves the inputs with the gains applied.
void integrate(const Potential& p, Index first, Index cells, const double* previous, double* vm);

/// The chance of a cell to be active, from the parameter: the original compares u * 0.99999999 with 1 -
/// probability.
inline double chance(double probability) { return 1 - (1 - probability) / 0.99999999; }

/// 1 in the cells that may be active in this cycle, 0 in those that stay silent; null when the probability is
/// 1, and then nothing is drawn.
inline const double* mask(const NeuronColumns& c, double probability) {
    return probability < 1 ? c.events(chance(probability)).data() : nullptr;
}

}  // namespace forage::membrane
