#pragma once

#include <cmath>

#include "core/types/neuron.h"

namespace forage {

/// Learns the values of its input cells by temporal differences. When the input changes, the value of each
/// cell changes by alpha * delta * its previous input, where delta = reward + gamma * V(now) - V(before), and
/// V is the sum of value * input. The reward is the modulatory input of cell 0. All cells act on each other:
/// one group is one critic.
struct TDValue {
    double alpha_plus = 0.5, alpha_minus = 0.1, gamma = 1;

    static void describe(NeuronSpec<TDValue>& s) {
        using T = TDValue;
        s.name("neuronTDValue", "TD value").doc("Learns values by temporal differences.");
        s.reads(InputKind::excitatory, InputKind::modulatory);
        s.param("alphaPlus", &T::alpha_plus)
            .label("Alpha plus")
            .range(0, 1)
            .doc("Learning rate when delta is positive.");
        s.param("alphaMinus", &T::alpha_minus)
            .label("Alpha minus")
            .range(0, 1)
            .doc("Learning rate otherwise.");
        s.param("gamma", &T::gamma).label("Gamma").range(0, 1).doc("Weight of the value to come.");
        s.state("old", "Previous input")
            .state("curr", "Current input")
            .state("reward", "Reward")
            .output("value", "Value");
    }
    void update(NeuronColumns& c) const {
        auto [old, curr, reward, value] = c.states<4>();
        reward += c.modulation();
        value = (value < 0.01).select(0.0, value);
        if (!(distance(curr, c.excitation()) > 0.001)) return;
        old = curr;
        curr = c.excitation();
        const double delta = reward[0] + gamma * dot(value, curr) - dot(value, old);
        value += (delta > 0 ? alpha_plus : alpha_minus) * delta * old;
        reward.setZero();
    }

  private:
    // These are plain sums from the first cell to the last, because Eigen's sum() adds in another order.
    static double dot(const Column& a, const Column& b) {
        double sum = 0;
        for (Index i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }
    static double distance(const Column& a, const Column& b) {
        double sum = 0;
        for (Index i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
        return sum;
    }
};

}  // namespace forage
