// What Linux reports about a gamepad: records of struct input_event, or of the older struct js_event.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "core/base/archive.h"

namespace forage::gamepad {

/// Axes in this order: left stick x and y, right stick x and y, left and right trigger, hat x and y.
constexpr std::size_t max_axes = 8;
constexpr std::size_t max_buttons = 16;

/// The state of a gamepad.
struct State {
    std::array<double, max_axes> axes{};      ///< -1 to 1, right and down are positive
    std::array<bool, max_buttons> buttons{};  ///< whether it is pressed
    void checkpoint(Archive& archive) { archive(axes, buttons); }
};

/// The formats of a device: /dev/input/event* has the first, /dev/input/js* the second.
enum class Format { evdev, joystick };

/// The size of a record, bytes.
std::size_t record_size(Format format);

/// Whether a text, of which the end may be missing, is made of records of one of the formats.
bool are_records(std::string_view text);

/// The values of an axis at its ends.
struct Range {
    int low = -32768, high = 32767;
};

/// Reads records, of which the last may be incomplete, and keeps the state that they tell.
class Reader {
  public:
    /// `range_of` gives the range of an axis, by its number in Linux (ABS_X, ...). Without it, sticks and
    /// triggers have 16 bits, and hats -1 to 1.
    explicit Reader(Format format = Format::evdev, std::function<Range(int)> range_of = {})
        : format_(format), range_of_(std::move(range_of)) {}

    /// Reads bytes up to the end of the next report, when a gamepad has sent all that happened at
    /// one time. Returns the number of bytes that it has taken, and sets `complete` when a report ended.
    std::size_t read(std::string_view bytes, bool& complete);
    /// The state after the last complete report.
    const State& state() const { return state_; }

    void checkpoint(Archive& archive) { archive(state_, next_, lost_, partial_, partial_size_); }

  private:
    bool record(const char* bytes);

    Format format_;
    std::function<Range(int)> range_of_;
    State state_, next_;  ///< after the last report, and within the present one
    bool lost_ = false;   ///< whether the device has lost events, up to the end of the report
    std::array<char, 24> partial_{};
    std::size_t partial_size_ = 0;
};

}  // namespace forage::gamepad
