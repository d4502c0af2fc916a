#include "bug_interface/simulation/trials.h"

#include <cmath>

namespace forage::bug {

void TrialLog::begin(const Pose2& start, std::uint64_t cycle) {
    current_ = {};
    current_.number = static_cast<int>(finished_.size()) + 1;
    current_.start = start;
    current_.first_cycle = cycle;
    smallest_squared_ = std::numeric_limits<double>::infinity();
    running_ = true;
    follow(start);
}

void TrialLog::finish(const Pose2& end, std::uint64_t done) {
    if (!running_) return;
    finished_.push_back(current(end, done));
    running_ = false;
}

Trial TrialLog::current(const Pose2& pose, std::uint64_t done) const {
    Trial trial = current_;
    if (!running_) {
        trial = {};
        trial.number = static_cast<int>(finished_.size()) + 1;
        trial.start = trial.end = pose;
        trial.first_cycle = done;
        return trial;
    }
    trial.end = pose;
    trial.cycles = done - std::min(done, trial.first_cycle);
    trial.smallest_distance = std::sqrt(smallest_squared_);
    trial.reached_target = trial.smallest_distance < reach_;
    return trial;
}

}  // namespace forage::bug
