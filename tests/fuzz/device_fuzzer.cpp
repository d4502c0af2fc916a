// What gamepads and ffmpeg send. The first byte chooses the format; the rest arrives in pieces.
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "modules/devices/gamepad/evdev.h"
#include "modules/devices/video/ppm.h"
#include "tests/fuzz/holds.h"

namespace {

using namespace forage;

void events(gamepad::Format format, std::string_view bytes) {
    gamepad::Reader reader(format);
    while (!bytes.empty()) {
        bool complete = false;
        const auto piece = bytes.substr(0, 37);
        const std::size_t taken = reader.read(piece, complete);
        test::holds(taken > 0 && taken <= piece.size(), "a reader takes bytes");
        test::holds(complete || taken == piece.size(), "a reader stops at the end of a report only");
        bytes.remove_prefix(taken);
        for (const double a : reader.state().axes) test::holds(std::abs(a) <= 1, "an axis is -1 to 1");
    }
}

void pictures(std::string_view bytes) {
    video::PpmStream stream;
    try {
        for (std::size_t at = 0; at < bytes.size(); at += 37) {
            stream.add(bytes.substr(at, 37));
            while (const auto p = stream.next()) {
                test::holds(p->rgb.size() ==
                                3 * static_cast<std::size_t>(p->width) * static_cast<std::size_t>(p->height),
                            "a picture is complete");
                const auto cells = video::resampled(*p, 3, 2);
                test::holds((cells >= 0).all() && (cells <= 1 + 1e-12).all(), "cells are 0 to 1");
            }
        }
    } catch (const std::runtime_error&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] % 3 == 2)
        pictures(bytes);
    else
        events(data[0] % 3 == 0 ? gamepad::Format::evdev : gamepad::Format::joystick, bytes);
    return 0;
}
