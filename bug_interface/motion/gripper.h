// The links of a robot, and the hinges of its gripper.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// A link of a robot and its position in the robot.
struct RobotLink {
    const Link* link = nullptr;
    Pose home = Pose::Identity();  ///< pose in the frame of the robot, with all hinges at angle 0
    int hinge = -1;  ///< number of the hinge that moves the link; -1 when it is fixed to the body
};

class Hinges;

/// The links of a robot's model and of the models nested in it. The hinges between them are added to
/// `hinges`. `model` must outlive the result.
std::vector<RobotLink> links_of(const Model& model, Hinges& hinges);

/// The hinges of a gripper, which all open or close together. The original applies a torque of 3 N m to every
/// hinge and resets all velocities in every step, so that the angular velocity is torque / inertia * step.
class Hinges {
  public:
    struct Hinge {
        std::string name;
        int parent = -1;              ///< number of the hinge that carries this one; -1 for the body
        double x = 0, y = 0;          ///< the axis in the frame of the robot, with all hinges at angle 0, m
        double sense = 1;             ///< 1 when the angle grows to the left (counter-clockwise), else -1
        double lower = 0, upper = 0;  ///< limits of the angle, rad
        double inertia = 0;           ///< moment of inertia of all links that turn with the hinge, kg m^2
        double angle = 0;             ///< rad; at 0 the links are where the file puts them
    };

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const Hinge& operator[](std::size_t i) const { return all_[i]; }

    /// Closes or opens the gripper; called once per cycle. As in the original, a command to close has no
    /// effect before the first command to open.
    void command(bool close);
    bool closing() const { return torque_ > 0; }

    /// The angle of hinge i after `steps` steps of `step` (s), within its limits, rad.
    double next(std::size_t i, double step, std::uint64_t steps) const;
    void set(std::size_t i, double angle) { all_[i].angle = angle; }
    /// The displacement of the links that turn with hinge i, in the frame of the robot. It includes the
    /// rotations of the hinges that carry hinge i.
    Pose2 displacement(std::size_t i) const;
    /// Whether hinge i turns with hinge `other`: it is the same hinge or is carried by it.
    bool turns_with(int i, int other) const;

    void checkpoint(Archive& archive) {
        for (Hinge& hinge : all_) archive(hinge.angle);
        archive(close_command_, torque_);
    }

    static constexpr double torque = 3;  ///< N m

  private:
    friend std::vector<RobotLink> links_of(const Model& model, Hinges& hinges);
    std::vector<Hinge> all_;
    bool close_command_ = true;
    double torque_ = 0;  ///< N m; 0 before the first command to open
};

}  // namespace forage::bug
