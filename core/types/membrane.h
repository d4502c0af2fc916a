// What the neuron types of the original have in common: a membrane that sums and leaks, and events at random.
#pragma once

#include <limits>

#include "core/types/neuron.h"

namespace forage {

/// The membrane of a cell: gains, leak and clipping, as a member of a neuron type.
struct Membrane {
    double exc_gain = 1, inh_gain = 1, persistence = 0;
    bool clip = false;
    double minimum = 0, maximum = 1;

    /// Declares the inputs and parameters of a type with the member `m`.
    template <class T>
    static void describe(NeuronSpec<T>& s, Membrane T::*m) {
        s.reads(InputKind::excitatory, InputKind::inhibitory);
        s.param("excGain", m, &Membrane::exc_gain)
            .label("Excitatory gain")
            .range(0, 10)
            .doc("Gain of the summed excitation.");
        s.param("inhGain", m, &Membrane::inh_gain)
            .label("Inhibitory gain")
            .range(0, 10)
            .doc("Gain of the summed inhibition.");
        s.param("vmPrs", m, &Membrane::persistence)
            .label("Membrane persistence")
            .range(0, 1)
            .doc("Part of the potential kept per cycle.");
        s.param("clipVm", m, &Membrane::clip)
            .label("Clip potential")
            .doc("Keep the potential between its minimum and its maximum.");
        s.param("vmMin", m, &Membrane::minimum)
            .label("Minimum potential")
            .range(0, 1)
            .doc("Lowest potential when it is clipped.");
        s.param("vmMax", m, &Membrane::maximum)
            .label("Maximum potential")
            .range(0, 1)
            .doc("Highest potential when it is clipped.");
    }
    /// Warns when the minimum is above the maximum, because vm would always be the maximum.
    void check(Diagnostics& diagnostics) const {
        if (clip && minimum > maximum)
            diagnostics.warning(at_parameter("vmMin"), "vmMin is above vmMax: the potential is always vmMax",
                                "exchange them");
    }

    /// Returns vm * vmPrs + excGain * excitation - inhGain * inhibition, clipped if `clip` is set; a NaN
    /// stays a NaN. Applies the gains to `in` in place, so that recordings show the inputs with their gains.
    double integrate(double vm, Input& in) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double low = clip ? minimum : -infinity, high = clip ? maximum : infinity;
        in.excitation *= exc_gain;
        in.inhibition *= inh_gain;
        double v = vm * persistence + in.excitation - in.inhibition;
        v = v < low ? low : v;
        return v > high ? high : v;
    }
};

/// The event probability of a type with the parameter `probability`. The original compares u * 0.99999999
/// with 1 - probability, where u is uniform in [0, 1].
inline double chance(double probability) { return 1 - (1 - probability) / 0.99999999; }

}  // namespace forage
