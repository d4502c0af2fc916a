#pragma once

#include "core/types/membrane.h"

namespace forage {

/// Cells spike at random, with a fixed amplitude, independently in each cell and cycle. They receive no
/// input.
struct RandomSpike {
    double probability = 0.3, amplitude = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(NeuronSpec<RandomSpike>& s) {
        using T = RandomSpike;
        s.name("neuronRandomSpike", "Random spike")
            .doc("Spikes at random, without input; constant when the probability is 1.");
        s.param("probability", &T::probability)
            .label("Probability")
            .range(0, 1)
            .doc("Chance of a spike per cell and cycle; with 1, the cells are always on.");
        s.param("spkAmpl", &T::amplitude).label("Spike amplitude").range(0, 1).doc("Activity of a spike.");
        s.output("act", &Cell::act, "Activity");
    }
    double event_probability() const { return chance(probability); }
    double event_value() const { return amplitude; }
};

}  // namespace forage
