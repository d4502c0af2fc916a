// How forces become wheel speeds.
#pragma once

#include "modules/allostasis/needs.h"

namespace forage::allostasis {

/// Speeds of the wheels, rad/s.
struct Wheels {
    double right = 0, left = 0;
    friend bool operator==(const Wheels&, const Wheels&) = default;
    void checkpoint(Archive& archive) { archive(right, left); }
};

inline constexpr double fastest_wheel = 6.2;  ///< of any command, rad/s

/// Turns towards what is needed and away from the predator. A side is +1 when a field has more to the left of
/// the robot.
class Steering {
  public:
    /// `bearing` is minus the heading, degrees 0..360. With `dead_sector`, as in the original, the sides keep
    /// their last values while the robot looks east (bearing above 337 or at most 22 degrees). The result is
    /// cut at 6.2 rad/s; `u_right` and `u_left` are uniform in [0, 1).
    Wheels step(double bearing, const LocalViews& views, const FiveNeeds& forces, double setpoint,
                bool dead_sector, double u_right, double u_left);

    const FiveNeeds& sides() const { return sides_; }            ///< -1, 0 or 1
    const FiveNeeds& directions() const { return directions_; }  ///< 1: attraction, -1: repulsion
    void checkpoint(Archive& archive) { archive(sides_, directions_); }

  private:
    FiveNeeds sides_ = FiveNeeds::Zero(), directions_ = FiveNeeds::Zero();
};

/// The four range sensors at the front: metres to the next surface, at -17, -49, 49 and 17 degrees.
struct FrontRanges {
    double ps0 = 0.3, ps1 = 0.3, ps6 = 0.3, ps7 = 0.3;
};

/// Holds a command for half a second, and turns away from obstacles.
class WheelControl {
  public:
    /// `time` in s. Adds the noise `z` times 1 rad/s at every call for the control agent, whose steering is
    /// to be ignored: z is 0 otherwise.
    Wheels step(double time, const FrontRanges& ranges, const Wheels& wanted, const Wheels& z);
    void checkpoint(Archive& archive) { archive(last_, wheels_); }

  private:
    double last_ = 0;
    Wheels wheels_;
};

/// The random walk of the mate or of the predator.
struct WalkSettings {
    double lowest, highest, fastest_turn;  ///< wheel speeds, rad/s
    int interval = 10;                     ///< steps between random changes
};
inline constexpr WalkSettings mate_walk{3, 6, 4}, predator_walk{1, 4, 2.5};

class RandomWalk {
  public:
    /// `ranges` are the eight sensors ps0 to ps7, m. `z` are standard normal numbers for the right and the
    /// left wheel, which are used only in steps in which drew() is true afterwards.
    Wheels step(const Eigen::Array<double, 8, 1>& ranges, const Wheels& z, const WalkSettings& settings);
    bool drew() const { return drew_; }  ///< whether the last step used z
    void checkpoint(Archive& archive) { archive(wheels_, counter_, drew_); }

  private:
    Wheels wheels_{3, 3};
    int counter_ = 0;
    bool drew_ = false;
};

}  // namespace forage::allostasis
