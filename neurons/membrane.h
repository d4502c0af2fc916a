// What several neuron types share: parameters of the membrane, its potential and the random mask.
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
void check_bounds(const T& p, Diagnostics& diagnostics) {
    if (p.clip && p.minimum > p.maximum)
        diagnostics.warning(at_parameter("vmMin"), "vmMin is above vmMax: the potential is always vmMax",
                            "exchange them");
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

namespace detail {

template <bool Exc, bool Inh, class Fire>
[[gnu::always_inline]] inline void integrate(const Potential& p, Index cells, const double* previous,
                                             Fire fire) {
    // One by one: in small groups it is felt when what was just written as numbers is copied as a whole.
    const double exc_gain = p.exc_gain, inh_gain = p.inh_gain, persistence = p.persistence;
    const double minimum = p.minimum, maximum = p.maximum;
    double *const exc = p.exc, *const inh = p.inh;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < cells; ++i) {
        double v = previous[i] * persistence + (Exc ? exc[i] *= exc_gain : 0.0);
        v -= Inh ? inh[i] *= inh_gain : 0.0;
        v = v < minimum ? minimum : v;
        fire(i, v > maximum ? maximum : v);
    }
}

}  // namespace detail

/// Calls fire(cell, vm) for the cells in one pass, where
/// vm = ((vm * vmPrs) + exc * excGain) - inh * inhGain, then clipped from below and from above if asked;
/// `previous` is the potential that persists. NaN passes. Leaves the inputs with the gains applied. To be
/// called in a function that is compiled with FORAGE_SIMD.
template <class Fire>
[[gnu::always_inline]] inline void integrate(const Potential& p, Index cells, const double* previous,
                                             Fire fire) {
    if (p.exc && p.inh)
        detail::integrate<true, true>(p, cells, previous, fire);
    else if (p.exc)
        detail::integrate<true, false>(p, cells, previous, fire);
    else if (p.inh)
        detail::integrate<false, true>(p, cells, previous, fire);
    else
        detail::integrate<false, false>(p, cells, previous, fire);
}

/// The chance of a cell to be active, from the parameter: the original compares u * 0.99999999 with 1 -
/// probability.
inline double chance(double probability) { return 1 - (1 - probability) / 0.99999999; }

/// 1 in the cells that may be active in this cycle, 0 in those that stay silent; null when the probability is
/// 1, and then nothing is drawn.
inline const double* mask(const NeuronColumns& c, double probability) {
    return probability < 1 ? c.events(chance(probability)).data() : nullptr;
}

}  // namespace forage::membrane
