// Statistics of what motor groups command.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "core/observe/observer.h"
#include "core/run/run.h"

namespace forage {

/// Counts which cells of the motor groups won, and so drove the robots. Cycles in which a robot is reset do
/// not count.
class MotorStatistics final : public Observer {
  public:
    /// `world` must outlive the observer.
    MotorStatistics(const Run& run, const bug::World& world);

    void declare(engine::Demand& demand) const override;
    void after_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override;

    /// One sentence per motor group that was ever active, such as "Bug/Motor drove the robot Bug: (5,1)
    /// straight ahead 86 %, (4,2) ahead, turning left 9 %, no command 5 % of the cycles".
    std::vector<std::string> sentences() const;

  private:
    struct Motor {
        std::string path;  ///< of the group
        int group, state, width, height;
        std::size_t robot;
        std::uint64_t cycles = 0, tied = 0;          ///< tied: several cells were equally active
        std::map<std::uint64_t, std::uint64_t> won;  ///< how often, by the number of the cell
    };
    std::string sentence(const Motor& motor) const;

    const bug::World& world_;
    std::vector<Motor> motors_;
};

}  // namespace forage
