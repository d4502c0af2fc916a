// The parameters of sequential episodic control.
#pragma once

namespace forage::sec {

/// Which sequences a full long-term memory loses.
enum class Forgetting {
    none,           ///< NONE: no sequence; further ones are not stored
    oldest,         ///< FIFO: the oldest sequence
    lowest_reward,  ///< RWD: the sequence with the lowest reward
    lowest_share,   ///< RWD-PROP: the given share of the sequences, those with the lowest rewards
    prioritized     ///< PRIOR: a random sequence; the lower its reward, the more probable
};

/// The factors of a segment's value: its collector c, its relative reward r and its discounted distance to
/// the reward, exp(-d / tau).
struct ValueFunction {
    bool collector = true, reward = true, distance = true;
};

/// The parameters of an update, all dimensionless; they may change between updates. The symbols are those of
/// Freire et al., "Sequential memory improves sample and memory efficiency in episodic control"
/// (arXiv:2112.14734).
struct Settings {
    bool sequential_bias = true;        ///< false: collectors ignore the triggers (NSEC)
    double trigger_decay = 0.05;        ///< alpha: fraction by which a trigger returns to 1 per couplet
    double trigger_increment = 0.01;    ///< beta: what a segment gains whose predecessor was selected
    double absolute_threshold = 0.98;   ///< theta: a segment is selected only if its collector is above it
    double relative_threshold = 0.995;  ///< omega: ... and above this fraction of the largest collector
    double distance_constant = 0.9;     ///< tau: distance after which a segment's value has fallen to 1/e
    double forgotten_share = 0.1;       ///< phi: share of the sequences that RWD-PROP forgets
    ValueFunction value;
    Forgetting forgetting = Forgetting::oldest;
    bool softmax = false;  ///< probabilities are exp(Q) / sum exp(Q) instead of Q / sum Q
    bool greedy = false;   ///< the most probable action is chosen, instead of a random one
};

}  // namespace forage::sec
