// The limbs of a robot: what is fixed to its body, and what turns on hinges.
#pragma once

#include <string>
#include <vector>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// A link of a robot and where it is.
struct Limb {
    const Link* link = nullptr;
    Pose home = Pose::Identity();  ///< in the robot's frame, with all hinges at 0
    int hinge = -1;                ///< that it turns with; -1: it is fixed to the body
};

/// The links of a robot's model and of the models in it, and the hinges between them. `model` must outlive
/// the limbs.
class Hinges;
std::vector<Limb> limbs_of(const Model& model, Hinges& hinges);

/// Hinges that all open or close at once, as fast as they can: a gripper. The original applies a torque of 3
/// N m to each hinge and forgets velocities in every step, which makes torque / inertia * step the speed.
class Hinges {
  public:
    struct Hinge {
        std::string name;
        int parent = -1;              ///< the hinge that carries it; -1: the body
        double x = 0, y = 0;          ///< of the axis in the robot's frame, with all hinges at 0, m
        double sense = 1;             ///< 1: to the left as the angle grows
        double lower = 0, upper = 0;  ///< rad
        double inertia = 0;           ///< of all that turns with it, kg m^2
        double angle = 0;             ///< rad; 0 is where the file puts the links
    };

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const Hinge& operator[](std::size_t i) const { return all_[i]; }

    /// Told every cycle. As in the original nothing happens before it was first told to open.
    void command(bool close);
    bool closing() const { return torque_ > 0; }

    /// Where hinge i is after a step of `step` s; its angle when it does not move.
    double next(std::size_t i, double step) const;
    void set(std::size_t i, double angle) { all_[i].angle = angle; }
    /// What turns with hinge i is displaced by this, in the robot's frame: rotations about its axis and those
    /// that carry it.
    Pose2 frame(std::size_t i) const;
    /// Whether hinge i is `by` or is carried by it.
    bool turns_with(int i, int by) const;

    void checkpoint(Archive& archive) {
        for (Hinge& hinge : all_) archive(hinge.angle);
        archive(told_to_close_, torque_);
    }

    static constexpr double torque = 3;  ///< N m

  private:
    friend std::vector<Limb> limbs_of(const Model& model, Hinges& hinges);
    std::vector<Hinge> all_;
    bool told_to_close_ = true;
    double torque_ = 0;
};

}  // namespace forage::bug
