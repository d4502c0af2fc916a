// The choice of an action among the segments that a retrieval selected.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "modules/sequential_episodic_control/episodic_memory.h"

namespace forage::sec {

/// The last decision. While nothing is selected, the values, the policy and the entropy of the decision
/// before remain.
struct Decision {
    int action = -1;        ///< number of the chosen action; -1: none
    Eigen::ArrayXd values;  ///< Q: sum of the values of the selected segments with this action
    Eigen::ArrayXd policy;  ///< p: probability of each action before the choice
    double entropy = 0;     ///< H = -sum p log2 p, bits

    Decision() = default;
    explicit Decision(Index actions)
        : values(Eigen::ArrayXd::Zero(actions)), policy(Eigen::ArrayXd::Zero(actions)) {}

    /// Decides by the segments of a retrieval; without one, the action is none. `uniform` returns a number in
    /// [0, 1); it is called once, or not at all when the choice is greedy.
    void decide(const std::vector<Match>& matches, const Settings& settings,
                const std::function<double()>& uniform);

    void checkpoint(Archive& archive) { archive(action, values, policy, entropy); }
};

/// The value of a segment: the product of those of c, r and exp(-d / tau) that the value function has.
double value_of(const Match& match, const Settings& settings);

}  // namespace forage::sec
