// One robot of a simulated world: its model, its state and its sensors.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/motion/gripper.h"
#include "bug_interface/motion/motor.h"
#include "bug_interface/motion/physics.h"
#include "bug_interface/motion/reset.h"
#include "bug_interface/simulation/body_poses.h"
#include "bug_interface/simulation/communication.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/simulation/robot_sensors.h"
#include "bug_interface/simulation/trials.h"

namespace forage::bug {

/// A robot of a World. Only the World creates and changes robots; therefore the members are public.
class Robot {
  public:
    /// `model` must have a robot_link(). `number` is that of the robot among the bodies, and `noise` says
    /// whether the sensors are noisy. Reports an error when the body is not an upright cylinder at the origin
    /// of the model, and when the world has too many heights.
    Robot(const Model& model, std::size_t number, std::uint64_t seed, bool noise, Heights& heights,
          Diagnostics& diagnostics);

    /// Turns the hinges for `steps` substeps of `step` s. A hinge keeps its angle when its way is blocked,
    /// until retry_hinges() is called.
    void move_gripper(Physics& physics, double step, std::uint64_t steps);
    void retry_hinges() { blocked_.assign(hinges.size(), 0); }
    /// How far any point of the gripper can move within a substep of `step` s, m.
    double gripper_travel(double step) const;

    void checkpoint(Archive& archive);

    // ---- constant ----
    std::string name;
    std::size_t number;
    Body body;
    std::vector<MovingSolid> solids;    ///< collision shapes
    std::vector<MovingVisual> visuals;  ///< what cameras see of the robot
    std::vector<MovingOutline> parts;   ///< `body.parts` with the hinges that move them

    // ---- state ----
    Pose2 pose;            ///< pose at the end of the last cycle; during a reset, a random start pose
    MotorCommand command;  ///< holds until the next one
    Hinges hinges;
    RandomStream motor_noise;
    std::optional<Reset> reset;      ///< empty for a robot that is never reset
    std::optional<TrialLog> trials;  ///< never empty in a complete World
    Transceiver transceiver;
    RobotSensors sensors;
    std::weak_ptr<void> claim;  ///< held by the module that drives the robot

  private:
    bool turn_hinge(Physics& physics, std::size_t hinge, double angle);

    std::vector<char> blocked_;                            ///< per hinge
    std::vector<std::pair<std::size_t, Outline>> turned_;  ///< the parts that a hinge turns
};

}  // namespace forage::bug
