// moduleQLearner: a table of the values of actions, learned from rewards (Watkins & Dayan 1992).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/types/module.h"

namespace forage::q_learner {

/// Learns Q(s, a) of states rounded to a few levels per cell. With the probability `exploration`, and in
/// states without a value above 0, it proposes nothing, so that other layers explore; it learns from the
/// action that is executed. Its ports are those of moduleSEC, so one can take the other's place.
class QLearnerModule {
  public:
    int interval = 4, levels = 4;
    double rate = 0.2, discount = 0.95, exploration = 0.1, penalty = 0.001;

    static void describe(ModuleSpec<QLearnerModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) { archive(table_, state_, pending_, at_end_, reward_, cycles_); }

    std::size_t states() const { return table_.size(); }

  private:
    void learn(int action, double future);
    void decide(ModuleFrame& frame);

    RandomStream random_;
    Index actions_ = 0;
    std::map<std::string, std::vector<double>> table_;  ///< the values of the actions in each state
    std::string state_;                                 ///< of the last decision
    bool pending_ = false;                              ///< whether state_ waits for what follows it
    bool at_end_ = false;                               ///< in the last cycle
    double reward_ = 0;                                 ///< since the last decision
    std::int64_t cycles_ = 0;                           ///< of this episode
};

}  // namespace forage::q_learner
