#pragma once

#include "core/types/neuron.h"

namespace forage {

/// vm as in the linear threshold type; a cell spikes (act = 1) where vm reaches the threshold, with the given
/// probability, and a spike lowers vm by vmReset / spkAmpl. The amplitude does not scale the spike, as in the
/// original.
struct IntegrateFire {
    double exc_gain = 1, inh_gain = 1, persistence = 0;
    bool clip = false;
    double minimum = 0, maximum = 1, probability = 1, threshold = 0, amplitude = 1, reset = 0;

    static void describe(NeuronSpec<IntegrateFire>& spec);
    void check(Diagnostics&) const;
    void update(NeuronColumns&) const;
};

}  // namespace forage
