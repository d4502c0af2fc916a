#include "modules/devices/gamepad/module.h"

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace forage::gamepad {

/// An open device, pipe or file.
struct GamepadModule::File {
    int handle = -1;
    bool regular = false;
    ~File() {
        if (handle >= 0) close(handle);
    }
};

void GamepadModule::describe(ModuleSpec<GamepadModule>& s) {
    using T = GamepadModule;
    s.name("moduleJoystick", "Joystick")
        .doc("Shows the sticks and buttons of a gamepad or joystick to groups.");
    s.param("DeviceName", &T::device)
        .label("Device")
        .at_start()
        .doc(
            "The device, /dev/input/js* or /dev/input/event*, or a file or pipe with its records. Names that "
            "begin with js have the records of a joystick, others those of evdev.");
    s.param("DeadZone", &T::dead_zone)
        .label("Dead zone")
        .range(0, 1)
        .doc("Positions of an axis up to this distance from its middle are 0.");
    s.output("JSOutput", "Axes")
        .size("2 cells per axis, in one row per axis",
              [](const T&, PortSizes&, const GroupShape& given) {
                  return rectangle(2, std::min(given.height, static_cast<int>(max_axes)));
              })
        .doc(
            "A row per axis: how far it is left or up, and how far it is right or down, 0 to 1. Of evdev, "
            "the rows are: left stick x and y, right stick x and y, left and right trigger, hat x and y; of "
            "a joystick, the axes as its driver counts them.");
    s.output("Buttons", "Buttons")
        .optional()
        .doc("A cell per button, from the first: 1 while it is pressed.");
}

void GamepadModule::start(const ModulePorts&) {
    const auto cannot = [&](const std::string& why) {
        return std::runtime_error(fmt::format(
            "the gamepad '{}' {}; connect one, or set DeviceName to another device or to recorded events",
            device, why));
    };
    file_ = std::make_shared<File>();
    file_->handle = open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file_->handle < 0)
        throw cannot(errno == ENOENT   ? "is not there"
                     : errno == EACCES ? "cannot be read: the group 'input' may"
                                       : "cannot be read: " + std::generic_category().message(errno));
    struct stat what {};
    if (fstat(file_->handle, &what) != 0 || S_ISDIR(what.st_mode)) throw cannot("is not a device");
    file_->regular = S_ISREG(what.st_mode);
    const bool joystick = std::filesystem::path(device).filename().string().starts_with("js");
    std::function<Range(int)> range_of;
    if (S_ISCHR(what.st_mode) && !joystick)
        range_of = [file = file_](int axis) {
            input_absinfo info{};
            if (ioctl(file->handle, EVIOCGABS(static_cast<unsigned>(axis)), &info) < 0) return Range{};
            return Range{info.minimum, info.maximum};
        };
    reader_ = Reader(joystick ? Format::joystick : Format::evdev, std::move(range_of));
    offset_ = 0;
    waiting_.clear();
}

void GamepadModule::update(ModuleFrame& frame) {
    char bytes[24 * 64];
    constexpr int max_reads = 64;  // in a cycle, so that a stream without an end does not hold up the run
    bool complete = false;
    for (int reads = 0; reads < max_reads;) {
        if (waiting_.empty()) {
            const auto size = read(file_->handle, bytes, sizeof bytes);
            if (size < 0 && errno == ENODEV)
                throw std::runtime_error(fmt::format("the gamepad '{}' is gone", device));
            if (size <= 0) break;
            ++reads;
            waiting_.assign(bytes, static_cast<std::size_t>(size));
        }
        const std::size_t taken = reader_.read(waiting_, complete);
        waiting_.erase(0, taken);
        offset_ += taken;
        if (complete && file_->regular) break;
    }
    const State& state = reader_.state();
    if (frame.is_read(0)) {
        auto out = frame.output(0);
        for (Index row = 0; 2 * row < out.size(); ++row) {
            const double at = state.axes[static_cast<std::size_t>(row)];
            const bool still = std::abs(at) <= dead_zone;
            out[2 * row] = still || at > 0 ? 0 : -at;
            out[2 * row + 1] = still || at < 0 ? 0 : at;
        }
    }
    if (frame.is_read(1)) {
        auto out = frame.output(1);
        for (Index i = 0; i < out.size(); ++i)
            out[i] =
                i < static_cast<Index>(max_buttons) && state.buttons[static_cast<std::size_t>(i)] ? 1 : 0;
    }
}

void GamepadModule::checkpoint(Archive& archive) {
    archive(reader_, offset_);
    if (!archive.loading()) return;
    waiting_.clear();
    if (file_->regular) lseek(file_->handle, static_cast<off_t>(offset_), SEEK_SET);
}

}  // namespace forage::gamepad
