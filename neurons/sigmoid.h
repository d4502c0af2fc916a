#pragma once

#include "core/types/neuron.h"

namespace forage {

/// vm = vm * vmPrs + excGain * exc - inhGain * inh, clipped if asked; act = (1 + tanh(2 * slope * (vm -
/// midpoint))) / 2.
struct Sigmoid {
    double exc_gain = 1, inh_gain = 1, persistence = 0;
    bool clip = false;
    double minimum = 0, maximum = 1, midpoint = 0, slope = 1;

    static void describe(NeuronSpec<Sigmoid>& spec);
    void check(Diagnostics&) const;
    void update(NeuronColumns&) const;
};

}  // namespace forage
