// Follows the robots of a world through a run.
#pragma once

#include <vector>

#include "bug_interface/simulation/world.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {

/// Collects a robot's path, trial by trial, in points at least 1 cm apart.
class PathLog {
  public:
    PathLog(const bug::World& world, std::size_t robot);
    /// After each cycle of the world.
    void follow();
    /// The paths of the finished trials and, if it has moved on, of the running one.
    std::vector<plot::Path> paths() const;

  private:
    void add(const bug::Pose2& pose);

    const bug::World& world_;
    std::size_t robot_, trials_ = 0;
    std::vector<plot::Path> finished_;
    plot::Path current_;
};

}  // namespace forage::tool
