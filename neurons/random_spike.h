#pragma once

#include "core/types/neuron.h"

namespace forage {

/// Spikes of a fixed amplitude, independent in each cell and cycle. Takes no input.
struct RandomSpike {
    double probability = 0.3, amplitude = 1;

    static void describe(NeuronSpec<RandomSpike>& s) {
        using T = RandomSpike;
        s.name("neuronRandomSpike", "Random spike").doc("Spikes at random, without input.");
        s.elementwise();
        s.param("probability", &T::probability)
            .label("Probability")
            .range(0, 1)
            .doc("Chance of a spike per cell and cycle.");
        s.param("spkAmpl", &T::amplitude).label("Spike amplitude").range(0, 1).doc("Activity of a spike.");
        s.output("act", "Activity");
    }
    void update(NeuronColumns& c) const;
};

}  // namespace forage
