// moduleJoystick: a gamepad or joystick as the activity of groups.
#pragma once

#include <memory>
#include <string>

#include "core/types/module.h"
#include "modules/devices/gamepad/evdev.h"

namespace forage::gamepad {

/// Reads a device, or a file of records. A device and a pipe give all that has arrived before a cycle; a
/// regular file gives one report per cycle, so that a run with it depends on nothing but the file.
class GamepadModule {
  public:
    static void describe(ModuleSpec<GamepadModule>& s);
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive);

  private:
    struct File;

    std::string device = "/dev/input/js0";
    double dead_zone = 0.1;

    std::shared_ptr<File> file_;
    Reader reader_;
    std::uint64_t offset_ = 0;  ///< bytes of a regular file that are read
    std::string waiting_;       ///< bytes that belong to a later report
};

}  // namespace forage::gamepad
