#include "modules/devices/video/recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace forage::video {
namespace {

constexpr std::array names = {"videoInputRed", "videoInputGreen", "videoInputBlue"};

/// Luminance and two differences of colours, 8 bits each in the limited range (ITU-R BT.601).
std::array<double, 3> yuv(double r, double g, double b) {
    return {16 + 65.481 * r + 128.553 * g + 24.966 * b, 128 - 37.797 * r - 74.203 * g + 112 * b,
            128 + 112 * r - 93.786 * g - 18.214 * b};
}

}  // namespace

void RecorderModule::describe(ModuleSpec<RecorderModule>& s) {
    using T = RecorderModule;
    s.name("moduleVideoRecorder", "Video recorder")
        .doc("Writes the activity of groups as a film, PROCESS_video.y4m, into the directory of results.");
    s.param("FPS", &T::fps)
        .label("Frames per second")
        .range(1, 1000)
        .unit("1/s")
        .at_start()
        .doc("Rate of the film.");
    s.param("Cycles Per Picture", &T::every)
        .label("Cycles per picture")
        .range(1, 10000)
        .doc("Every n-th cycle becomes a picture.");
    s.param("Scale", &T::scale)
        .range(1, 64)
        .unit("pixels")
        .at_start()
        .doc("Width and height of a cell in the film.");
    s.param("Minimum", &T::minimum).doc("The activity that is black.");
    s.param("Maximum", &T::maximum).doc("The activity that is white.");
    s.param("HSV", &T::hsv).doc("The inputs are hue, saturation and value.");
    s.input(names[0], "Red, hue or grey")
        .full_rectangle()
        .doc("Red or hue; without the others, the luminance.");
    s.input(names[1], "Green or saturation").optional().same_size_as(names[0]).doc("Green or saturation.");
    s.input(names[2], "Blue or value").optional().same_size_as(names[0]).doc("Blue or value.");
}

void RecorderModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    if (ports.inputs.size() == names.size() &&
        (ports.inputs[1].shape.cells > 0) != (ports.inputs[2].shape.cells > 0))
        diagnostics.error(at_port(names[1]), "a film in colours needs three groups",
                          "set videoInputGreen and videoInputBlue, or none of them");
    if (fps < 1) diagnostics.error(at_parameter("FPS"), "the rate is at least 1");
    if (scale < 1) diagnostics.error(at_parameter("Scale"), "a cell is at least one pixel wide");
    if (every < 1)
        diagnostics.error(at_parameter("Cycles Per Picture"), "a picture lasts at least one cycle");
    if (!(maximum > minimum))
        diagnostics.error(at_parameter("Maximum"),
                          fmt::format("the maximum, {}, is not above the minimum, {}", maximum, minimum));
}

void RecorderModule::start(const ModulePorts& ports) {
    shape_ = ports.inputs[0].shape;
    colours_ = ports.inputs[1].shape.cells > 0;
    file_ = &ports.open("video.y4m");
    *file_ << fmt::format("YUV4MPEG2 W{} H{} F{}:1 Ip A1:1 {}\n", shape_.width * scale, shape_.height * scale,
                          fps, colours_ ? "C444" : "Cmono");
}

void RecorderModule::update(ModuleFrame& frame) {
    if (frame.cycle() % static_cast<std::uint64_t>(every) != 0) return;
    Cells cells(shape_.cells, 3);
    for (Eigen::Index c = 0; c < 3; ++c) {
        const auto& in = frame.input(colours_ ? static_cast<std::size_t>(c) : 0);
        for (Eigen::Index i = 0; i < cells.rows(); ++i) {
            const double v = (in[i] - minimum) / (maximum - minimum);
            cells(i, c) = v > 0 ? std::min(v, 1.0) : 0;  // a NaN is black
        }
    }
    if (colours_ && hsv) make_rgb(cells);
    const auto bytes = [](double v) { return static_cast<char>(static_cast<unsigned char>(std::lround(v))); };
    std::string planes[3];
    for (int y = 0; y < shape_.height * scale; ++y)
        for (int x = 0; x < shape_.width * scale; ++x) {
            const Eigen::Index i = Eigen::Index{y / scale} * shape_.width + x / scale;
            if (!colours_) {  // in the full range, as readers expect it of grey
                planes[0] += bytes(255 * cells(i, 0));
                continue;
            }
            const auto v = yuv(cells(i, 0), cells(i, 1), cells(i, 2));
            for (std::size_t p = 0; p < 3; ++p) planes[p] += bytes(v[p]);
        }
    *file_ << "FRAME\n";
    for (const auto& plane : planes) *file_ << plane;
}

}  // namespace forage::video
