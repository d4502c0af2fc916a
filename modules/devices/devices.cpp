#include "modules/devices/devices.h"

#include "modules/devices/gamepad/module.h"
#include "modules/devices/video/module.h"
#include "modules/devices/video/recorder.h"

namespace forage {

void add_devices(Registry& registry) {
    registry.add(module_type<gamepad::GamepadModule>());
    registry.add(module_type<video::VideoModule>());
    ModuleType other_name = module_type<video::VideoModule>();
    other_name.name = "openCVvideo", other_name.label = "openCV Video";
    registry.add(std::move(other_name));
    registry.add(module_type<video::RecorderModule>());
}

}  // namespace forage
