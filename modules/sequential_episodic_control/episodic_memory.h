// The memories of sequential episodic control: recent couplets, and the sequences that led to rewards.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/base/archive.h"
#include "modules/sequential_episodic_control/settings.h"

namespace forage::sec {

using Eigen::Index;

/// A sequence of NS segments (pairs of state and action) and the reward that followed it. Column 0 is the
/// oldest segment, column NS - 1 the one before the reward.
struct Sequence {
    Eigen::ArrayXXd states;                          ///< N rows, one column per segment
    std::vector<int> actions;                        ///< numbers of actions
    double reward = 0;                               ///< R, above 0
    Eigen::ArrayXd triggers;                         ///< t, at least 1
    Eigen::ArrayXd collectors;                       ///< c of the last retrieval
    Eigen::Array<bool, Eigen::Dynamic, 1> selected;  ///< by the last retrieval

    void checkpoint(Archive& archive) { archive(states, actions, reward, triggers, collectors, selected); }
};

/// A segment that a retrieval selected.
struct Match {
    Index sequence = 0, column = 0;
    int action = 0;
    double collector = 0;        ///< c = similarity times trigger
    double relative_reward = 0;  ///< r = R divided by the largest R of the selected segments, 0..1
    double distance = 0;         ///< d = (NS - column) / NS: 1 for the oldest segment
};

/// A short-term memory of the last NS couplets, which is always full (at the start with zeros), and a
/// long-term memory of at most NL sequences.
class EpisodicMemory {
  public:
    EpisodicMemory() = default;
    /// `segments` is NS and `capacity` is NL, at least 1; `state_cells` is N.
    EpisodicMemory(Index segments, Index capacity, Index state_cells);

    /// Appends a couplet to the short-term memory. With the sequential bias, triggers decay towards 1, those
    /// of segments that the last retrieval selected become 1, and those of their successors rise.
    void remember(const Eigen::Ref<const Eigen::ArrayXd>& state, int action, const Settings& settings);

    /// Selects the segments whose collectors are above both thresholds. With an empty memory nothing happens
    /// and the result is empty.
    const std::vector<Match>& retrieve(const Eigen::Ref<const Eigen::ArrayXd>& state,
                                       const Settings& settings);

    /// Appends the short-term memory as a sequence if `reward` is above 0 and there is room. A memory that is
    /// full then, or was before, forgets. `uniform` returns a number in [0, 1) and is called only by
    /// Forgetting::prioritized.
    void store(double reward, const Settings& settings, const std::function<double()>& uniform);

    /// All triggers become 1. The short-term memory and what is selected remain, as in the original.
    void end_episode();
    /// Sets the short-term memory to zeros.
    void clear_recent();

    const std::deque<Sequence>& sequences() const { return sequences_; }
    Index segments() const { return recent_states_.cols(); }  ///< NS
    Index capacity() const { return capacity_; }              ///< NL

    void checkpoint(Archive& archive) {
        archive(recent_states_, recent_actions_, next_, capacity_, sequences_);
    }

  private:
    void forget(const Settings& settings, const std::function<double()>& uniform);

    Eigen::ArrayXXd recent_states_;  ///< a ring: one column per couplet
    std::vector<int> recent_actions_;
    Index next_ = 0;  ///< column of the oldest couplet, which the next one replaces
    Index capacity_ = 0;
    std::deque<Sequence> sequences_;  ///< in the order of storing
    std::vector<Match> matches_;      ///< of the last retrieval; not needed later
};

}  // namespace forage::sec
