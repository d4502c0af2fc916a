// The module that connects a neural system to a robot.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/sensing/image_cells.h"
#include "bug_interface/sensing/place_cells.h"
#include "bug_interface/simulation/world.h"
#include "core/types/module.h"

namespace forage::bug {

/// Module "moduleGazeboBug". In every cycle it decodes its input groups into commands to the robot, and
/// copies what the robot sensed at the end of the previous cycle into its output groups. describe() says what
/// their cells mean.
///
/// A group at _gripper or _proximityGripper is an error for a robot without a gripper, unless the parameter
/// `gripper` is false. The parameter `cps`, the rate of the module's own clock in the original, has no
/// effect, as the robot moves in lock-step with the system.
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
    /// Throws std::runtime_error when there is no world or no robot with this name, and when another module
    /// drives the robot.
    void start(const ModulePorts& ports, ModuleFrame& frame);
    void update(ModuleFrame& frame);
    void checkpoint(Archive&) {}  // the state of the robot belongs to the world

  private:
    void copy_scans(ModuleFrame& frame) const;
    void copy_pose(ModuleFrame& frame) const;
    void copy_image(ModuleFrame& frame);

    World* world_ = nullptr;
    std::size_t bug_ = 0;
    std::shared_ptr<void> claim_;
    GroupShape motor_, image_, place_;
    std::optional<ImageCells> image_cells_;
    std::vector<double> unused_;  ///< takes the colour channels without a group
};

/// The module type. Its modules drive robots of the run's environment, which must be a World. Without one,
/// systems can be checked but not run.
ModuleType gazebo_bug_type();

}  // namespace forage::bug
