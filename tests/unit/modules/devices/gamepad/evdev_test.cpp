// The records of gamepads.
#include "modules/devices/gamepad/evdev.h"

#include <cstring>

#include <linux/input.h>
#include <linux/joystick.h>

#include "tests/support/catch.h"

using namespace forage::gamepad;

namespace {

std::string event(int type, int code, int value) {
    input_event e{};
    e.type = static_cast<std::uint16_t>(type), e.code = static_cast<std::uint16_t>(code), e.value = value;
    return {reinterpret_cast<const char*>(&e), sizeof e};
}

const std::string report = event(EV_SYN, SYN_REPORT, 0);

State after(const std::string& bytes, Reader reader = Reader()) {
    bool complete = false;
    for (std::string_view left = bytes; !left.empty();) left.remove_prefix(reader.read(left, complete));
    return reader.state();
}

}  // namespace

TEST_CASE("A report changes axes and buttons when it is complete") {
    const std::string events = event(EV_ABS, ABS_X, 32767) + event(EV_ABS, ABS_RY, -32768) +
                               event(EV_ABS, ABS_HAT0Y, -1) + event(EV_KEY, BTN_SOUTH, 1) +
                               event(EV_KEY, BTN_START, 1);
    CHECK(after(events).axes[0] == 0);
    const State s = after(events + report);
    CHECK(s.axes == std::array<double, max_axes>{1, 0, 0, -1, 0, 0, 0, -1});
    CHECK(s.buttons[0]);
    CHECK(s.buttons[BTN_START & 0xf]);
    CHECK_FALSE(s.buttons[1]);
    CHECK_FALSE(after(events + report + event(EV_KEY, BTN_SOUTH, 0) + report).buttons[0]);
    CHECK(after(event(EV_KEY, BTN_TRIGGER, 1) + report).buttons[0]);  // of a joystick
    CHECK(after(event(EV_KEY, KEY_A, 1) + event(EV_REL, REL_X, 5) + report).buttons == State{}.buttons);
}

TEST_CASE("The range of the device scales its axes") {
    const Reader reader(Format::evdev, [](int axis) { return axis == ABS_X ? Range{0, 200} : Range{5, 5}; });
    const State s = after(event(EV_ABS, ABS_X, 150) + event(EV_ABS, ABS_Y, 5) + report, reader);
    CHECK(s.axes[0] == 0.5);
    CHECK(s.axes[1] == 0);
    CHECK(after(event(EV_ABS, ABS_X, 1000) + report, reader).axes[0] == 1);
}

TEST_CASE("What is left of a report after lost events is ignored") {
    const State s = after(event(EV_ABS, ABS_X, 32767) + report + event(EV_SYN, SYN_DROPPED, 0) +
                          event(EV_ABS, ABS_X, -32768) + report + event(EV_KEY, BTN_SOUTH, 1) + report);
    CHECK(s.axes[0] == 1);
    CHECK(s.buttons[0]);
}

TEST_CASE("Records may arrive in pieces, and a reader stops at the end of a report") {
    const std::string events = event(EV_ABS, ABS_X, 32767) + report + event(EV_ABS, ABS_X, -32768) + report;
    Reader reader;
    bool complete = false;
    std::size_t taken = 0;
    for (; !complete; ++taken) CHECK(reader.read(std::string_view(events).substr(taken, 1), complete) == 1);
    CHECK(taken == 2 * sizeof(input_event));
    CHECK(reader.state().axes[0] == 1);
    CHECK(reader.read(std::string_view(events).substr(taken), complete) == 2 * sizeof(input_event));
    CHECK(complete);
    CHECK(reader.state().axes[0] == -1);
}

TEST_CASE("The records of a joystick, with those of its state at the start") {
    const auto record = [](int type, int number, int value) {
        const js_event e{0, static_cast<std::int16_t>(value), static_cast<std::uint8_t>(type),
                         static_cast<std::uint8_t>(number)};
        return std::string(reinterpret_cast<const char*>(&e), sizeof e);
    };
    const State s = after(record(JS_EVENT_AXIS | JS_EVENT_INIT, 1, -32767) + record(JS_EVENT_BUTTON, 3, 1) +
                              record(JS_EVENT_AXIS, 200, 1),
                          Reader(Format::joystick));
    CHECK(s.axes[1] == -1);
    CHECK(s.buttons[3]);
}
