// The module that gives a neural system the senses and the motors of a robot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bug_interface/sensing/image_cells.h"
#include "bug_interface/sensing/place_cells.h"
#include "bug_interface/simulation/world.h"
#include "core/types/module.h"

namespace forage::bug {

/// Module "moduleGazeboBug". Once per cycle it decodes the motor group into a command to the robot
/// (decode_motor()) and copies what the robot sensed at the end of the previous cycle into the output groups:
///
///   _proximity, _target   near is high, cell 0 looks back left, the last back right; _target sees the light
///   _gps                  x + placeXMax, y + placeYMax in m, heading + pi in rad
///   _image_RH, .._BV      the camera's picture, row 0 is the far one
///   placeCell, headCell   where the robot is and where it looks, in fields
///
///   _proximityGripper     the rays between the fingers; the outer cells see the robot's own palm
///   _audio_in             what others with the same communication key say: _audio_out, quieter with distance
///
/// One cell of _gripper closes the gripper above 0.5 and opens it below. These two groups are an error with a
/// robot that has no gripper, unless the parameter gripper is false. The robot moves in lock-step with the
/// system, so that the parameter cps of the original, updates per second of the module's own clock, has no
/// effect.
class GazeboBug {
  public:
    std::string device_name = "iqrGazebo";
    double cps = 25;
    std::string comkey;
    bool gripper = true, grayscale = false, hsv = false;
    double trans_speed = 1, rot_speed = 0.1;
    double place_x_offset = 0, place_y_offset = 0, place_x_max = 10, place_y_max = 10, place_sigma = 0.2;
    double head_sigma = 0.2;

    static void describe(ModuleSpec<GazeboBug>& spec);
    void check(const ModulePorts& ports, Diagnostics& diagnostics);
    /// Throws std::runtime_error without a world or robot, or when another module has the robot.
    void start(const ModulePorts& ports, ModuleFrame& frame);
    void update(ModuleFrame& frame);
    void checkpoint(Archive&) {}  // the robot is a part of its world

  private:
    void copy_scans(ModuleFrame& frame) const;
    void copy_pose(ModuleFrame& frame) const;
    void copy_image(ModuleFrame& frame);

    World* world_ = nullptr;
    std::size_t bug_ = 0;
    std::shared_ptr<void> claim_;
    GroupShape motor_, image_, place_;
    std::vector<double> unused_;  ///< for colour channels that no group takes
};

/// The module type. Its modules drive robots of the run's environment, which must be a World; without one, systems
/// can be checked but not run.
ModuleType gazebo_bug_type();

}  // namespace forage::bug
