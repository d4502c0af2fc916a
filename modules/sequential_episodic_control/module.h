// moduleSEC: sequential episodic control as a module.
#pragma once

#include <string>

#include "core/types/module.h"
#include "modules/sequential_episodic_control/decision.h"
#include "modules/sequential_episodic_control/episodic_memory.h"

namespace forage::sec {

/// Remembers what led to rewards, and repeats it (Freire et al., arXiv:2112.14734). describe() lists its
/// ports. A decision is made in every k-th cycle of an episode and stays valid until the next one. The
/// couplet of a decision holds its state and the action that is executed k cycles later, or when the episode
/// ends.
class SequentialControlModule {
  public:
    int segments = 50, capacity = 500, interval = 4, least = 4;
    bool bias = true, ignore_silence = false, clear = false;
    double decay = 0.05, increment = 0.01, absolute = 0.98, relative = 0.995, constant = 0.9;
    double share = 0.1, goal = 1, penalty = 0.001, discrepancy = 0.01;
    std::string value = "default", policy = "proportional", choice = "sample", forgetting = "FIFO";

    static void describe(ModuleSpec<SequentialControlModule>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive) {
        archive(memory_, decision_, state_, pending_, shown_, at_goal_, at_end_, reward_, cycles_);
    }

    const EpisodicMemory& memory() const { return memory_; }
    const Decision& decision() const { return decision_; }

  private:
    void complete(const ModuleFrame& frame, const Settings& settings);
    void decide(ModuleFrame& frame, const Settings& settings);
    void show(ModuleFrame& frame) const;
    Settings settings() const;

    EpisodicMemory memory_;
    Decision decision_;
    RandomStream random_;
    Eigen::ArrayXd state_;                   ///< of the last decision
    bool pending_ = false;                   ///< whether state_ waits for the action that follows it
    bool shown_ = false;                     ///< whether the outputs have been written once
    bool at_goal_ = false, at_end_ = false;  ///< in the last cycle
    double reward_ = 0;                      ///< E: accumulated in this episode
    std::int64_t cycles_ = 0;                ///< of this episode
};

}  // namespace forage::sec
