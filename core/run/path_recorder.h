// The path of a robot through a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/run/trial.h"

namespace forage {

/// Collects a robot's path, trial by trial, in points that are 1 cm apart. When there are more than a million
/// points, the distance is doubled. Writes trajectory.csv.
class PathRecorder final : public Observer {
  public:
    /// `file` is the name of the table.
    PathRecorder(const Environment& environment, std::size_t robot, std::string file);

    struct Point {
        std::uint64_t cycle;
        Pose2 pose;
        void checkpoint(Archive& archive) { archive(cycle, pose); }
    };
    struct Path {
        std::vector<Point> points;
        bool reached = false, finished = false;
        void checkpoint(Archive& archive) { archive(points, reached, finished); }
    };
    /// The paths of the finished trials and of the running one, unless the robot is being reset.
    std::vector<Path> paths(const Environment& environment) const;
    std::size_t robot() const { return robot_; }

    void after_cycle(RunView& run) override;
    std::vector<std::string> file_names() const override { return {file_}; }
    void finish(RunView& run, ResultFiles& files) override;
    void checkpoint(Archive& archive) override { archive(finished_, current_, count_, spacing_); }

  private:
    void add(std::uint64_t cycle, const Pose2& pose, bool always);
    void thin();

    std::size_t robot_, count_ = 0;
    std::string file_;
    double spacing_ = 0.01;  ///< m
    std::vector<Path> finished_;
    Path current_;
};

}  // namespace forage
