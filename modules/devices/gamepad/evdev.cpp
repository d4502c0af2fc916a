#include "modules/devices/gamepad/evdev.h"

#include <algorithm>
#include <cstring>

#include <linux/input.h>
#include <linux/joystick.h>

namespace forage::gamepad {
namespace {

static_assert(sizeof(input_event) <= 24 && sizeof(js_event) == 8);

constexpr std::array<int, max_axes> axis_codes = {ABS_X, ABS_Y,  ABS_RX,    ABS_RY,
                                                  ABS_Z, ABS_RZ, ABS_HAT0X, ABS_HAT0Y};

double position(int value, Range range) {
    if (range.high <= range.low) return 0;
    const double part =
        (static_cast<double>(value) - range.low) / (static_cast<double>(range.high) - range.low);
    return std::clamp(2 * part - 1, -1.0, 1.0);
}

Range usual_range(int code) { return code == ABS_HAT0X || code == ABS_HAT0Y ? Range{-1, 1} : Range{}; }

}  // namespace

std::size_t record_size(Format format) {
    return format == Format::evdev ? sizeof(input_event) : sizeof(js_event);
}

bool are_records(std::string_view text) {
    const auto all = [&]<class Record>(Record e, auto is_sound) {
        for (auto rest = text; rest.size() >= sizeof e; rest.remove_prefix(sizeof e)) {
            std::memcpy(&e, rest.data(), sizeof e);
            if (!is_sound(e)) return false;
        }
        return text.size() >= sizeof e;
    };
    constexpr int second = 1'000'000;  // us
    return all(js_event{},
               [](const js_event& e) {
                   const int type = e.type & ~JS_EVENT_INIT;
                   return type == JS_EVENT_AXIS || type == JS_EVENT_BUTTON;
               }) ||
           all(input_event{}, [](const input_event& e) {
               return e.input_event_usec >= 0 && e.input_event_usec < second && e.type <= EV_MAX;
           });
}

std::size_t Reader::read(std::string_view bytes, bool& complete) {
    const std::size_t size = record_size(format_);
    std::size_t taken = 0;
    complete = false;
    while (!complete && taken < bytes.size()) {
        const std::size_t more = std::min(size - partial_size_, bytes.size() - taken);
        std::memcpy(partial_.data() + partial_size_, bytes.data() + taken, more);
        taken += more;
        partial_size_ += more;
        if (partial_size_ < size) break;
        partial_size_ = 0;
        complete = record(partial_.data());
    }
    return taken;
}

/// Returns whether a report has ended.
bool Reader::record(const char* bytes) {
    if (format_ == Format::joystick) {  // each record is a report of its own
        js_event e{};
        std::memcpy(&e, bytes, sizeof e);
        const int type = e.type & ~JS_EVENT_INIT;
        if (type == JS_EVENT_AXIS && e.number < max_axes)
            state_.axes[e.number] = position(e.value, {-32767, 32767});
        else if (type == JS_EVENT_BUTTON && e.number < max_buttons)
            state_.buttons[e.number] = e.value != 0;
        return true;
    }
    input_event e{};
    std::memcpy(&e, bytes, sizeof e);
    if (e.type == EV_SYN && e.code == SYN_DROPPED) {
        lost_ = true;  // the rest of this report is what was left
    } else if (e.type == EV_SYN && e.code == SYN_REPORT) {
        if (lost_)
            next_ = state_;
        else
            state_ = next_;
        lost_ = false;
        return true;
    } else if (e.type == EV_ABS) {
        const auto code = std::ranges::find(axis_codes, static_cast<int>(e.code));
        if (code != axis_codes.end())
            next_.axes[static_cast<std::size_t>(code - axis_codes.begin())] =
                position(e.value, range_of_ ? range_of_(e.code) : usual_range(e.code));
    } else if (e.type == EV_KEY && e.code >= BTN_JOYSTICK && e.code < BTN_GAMEPAD + max_buttons) {
        next_.buttons[e.code & 0xf] = e.value != 0;  // 16 buttons of joysticks, then 16 of gamepads
    }
    return false;
}

}  // namespace forage::gamepad
