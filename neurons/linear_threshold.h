#pragma once

#include "core/types/neuron.h"

namespace forage {

/// vm = vm * vmPrs + excGain * exc - inhGain * inh, clipped if asked; act = vm where it reaches the
/// threshold, and 0 elsewhere. With a probability below 1 each cell is silent in a random part of the cycles.
struct LinearThreshold {
    double exc_gain = 1, inh_gain = 1, persistence = 0;
    bool clip = false;
    double minimum = 0, maximum = 1, probability = 1, threshold = 0;

    static void describe(NeuronSpec<LinearThreshold>& spec);
    void check(Diagnostics&) const;
    void update(NeuronColumns&) const;
};

}  // namespace forage
