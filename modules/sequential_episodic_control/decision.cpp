#include "modules/sequential_episodic_control/decision.h"

#include <cmath>

namespace forage::sec {

double value_of(const Match& match, const Settings& settings) {
    double value = settings.value.reward ? match.relative_reward : 1;
    if (settings.value.distance) value *= std::exp(-match.distance / settings.distance_constant);
    return settings.value.collector ? match.collector * value : value;
}

void Decision::decide(const std::vector<Match>& matches, const Settings& settings,
                      const std::function<double()>& uniform) {
    action = -1;
    if (matches.empty()) return;
    values.setZero();
    for (const auto& m : matches) values[m.action] += value_of(m, settings);
    policy = settings.softmax ? (values - values.maxCoeff()).exp().eval() : values;
    policy /= policy.sum();
    entropy = 0;
    for (const double p : policy)
        if (p > 0) entropy -= p * std::log2(p);
    if (settings.greedy) {
        Index best = 0;
        policy.maxCoeff(&best);  // the first one of several
        action = static_cast<int>(best);
        return;
    }
    const double u = uniform();
    double total = 0, cumulative = 0;
    for (const double p : policy) total += p;
    int chosen = 0;
    for (Index a = 0; a < policy.size(); ++a) {
        cumulative += policy[a];
        if (cumulative / total <= u) chosen = static_cast<int>(a) + 1;
    }
    action = std::min(chosen, static_cast<int>(policy.size()) - 1);
}

}  // namespace forage::sec
