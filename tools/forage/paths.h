// Follows the robots of a world through a run.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {

/// Collects a robot's path, trial by trial, in points some distance apart: 1 cm, and twice as much each time
/// there are more than a million of them.
class PathLog {
  public:
    PathLog(const bug::World& world, std::size_t robot);
    /// After each cycle of the world.
    void follow();
    /// The paths of the finished trials and of the running one, unless the robot is being reset.
    std::vector<plot::Path> paths() const;
    /// trial,cycle,x,y,yaw of every point: where the robot was at the end of that cycle.
    std::string csv() const;

    void checkpoint(Archive& archive) { archive(finished_, current_, count_, spacing_); }

  private:
    struct Point {
        std::uint64_t cycle;
        Pose2 pose;
        void checkpoint(Archive& archive) { archive(cycle, pose); }
    };
    struct Trial {
        std::vector<Point> points;
        bool reached = false, finished = false;
        void checkpoint(Archive& archive) { archive(points, reached, finished); }
    };
    void add(std::uint64_t cycle, const Pose2& pose, bool always);
    void thin();
    static plot::Path drawn(const Trial& trial);

    const bug::World& world_;
    std::size_t robot_, count_ = 0;
    double spacing_ = 0.01;  ///< m
    std::vector<Trial> finished_;
    Trial current_;
};

}  // namespace forage::tool
