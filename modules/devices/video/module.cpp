#include "modules/devices/video/module.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace forage::video {
namespace {

constexpr std::size_t end_of_video = 3;  // the output after the three channels

}  // namespace

void VideoModule::describe(ModuleSpec<VideoModule>& s) {
    using T = VideoModule;
    s.name("moduleVideo", "Video")
        .doc(
            "Shows the pictures of a camera, a film or a folder of PNG files to groups, each in the size of "
            "its group.");
    s.param("File Name", &T::file_name)
        .label("File name")
        .path()
        .at_start()
        .doc("A film, or a folder of .png files, which are shown by name; empty for the camera.");
    s.param("DeviceName", &T::device).label("Device").at_start().doc("The camera, a Video4Linux device.");
    s.param("imgWidth", &T::image_width)
        .label("Image width")
        .range(1, longest_side)
        .unit("pixels")
        .at_start()
        .doc("Width of the pictures of the camera.");
    s.param("imgHeight", &T::image_height)
        .label("Image height")
        .range(1, longest_side)
        .unit("pixels")
        .at_start()
        .doc("Height of the pictures of the camera.");
    s.param("FPS", &T::fps)
        .label("Frames per second")
        .range(1, 1000)
        .unit("1/s")
        .at_start()
        .doc("Rate of the camera, and of a film or folder in real time.");
    s.param("HSV", &T::hsv).doc("The outputs are hue, saturation and value, each 0 to 1.");
    s.param("Monochrome", &T::monochrome)
        .doc("All outputs are the luminance, 0 to 1; then HSV has no effect.");
    s.param("Brightness", &T::brightness).range(0, 100).doc("50 leaves pictures unchanged.");
    s.param("Contrast", &T::contrast).range(0, 100).doc("50 leaves pictures unchanged.");
    s.param("Saturation", &T::saturation).range(0, 100).doc("50 leaves pictures unchanged.");
    s.param("Real Time", &T::real_time)
        .label("Real time")
        .at_start()
        .doc("The clock decides which picture is shown, instead of the number of the cycle.");
    s.param("Cycles Per Picture", &T::cycles_per_picture)
        .label("Cycles per picture")
        .range(1, 10000)
        .doc("How long a picture is shown, unless it is real time.");
    s.param("Step", &T::step).range(1, 10000).doc("Every n-th picture of a film or folder is shown.");
    s.param("Loop", &T::loop)
        .doc("A film or folder repeats after its end; otherwise the outputs are 0 then.");
    for (const auto& [name, member] :
         {std::pair{"Input", &T::input}, {"Standard", &T::standard}, {"AutoGain", &T::auto_gain}})
        s.param(name, member).doc("A setting of the original's driver, without effect.");
    for (const auto& [name, member] :
         {std::pair{"InfoWindow", &T::info_window}, {"ShowOutput", &T::show_output}})
        s.param(name, member).doc("A window of the original, without effect.");
    s.output("videoOutputRed", "Red, hue or grey")
        .full_rectangle()
        .doc("Red, hue or luminance of the picture.");
    s.output("videoOutputGreen", "Green or saturation")
        .optional()
        .full_rectangle()
        .doc("Green or saturation of the picture.");
    s.output("videoOutputBlue", "Blue or value")
        .optional()
        .full_rectangle()
        .doc("Blue or value of the picture.");
    s.output("End of video", "End of video")
        .optional()
        .cells(1)
        .doc("1 with the first picture after the end, and as long as there is none; else 0.");
}

void VideoModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    namespace fs = std::filesystem;
    std::error_code none;
    if (cycles_per_picture < 1)
        diagnostics.error(at_parameter("Cycles Per Picture"), "a picture is shown for at least one cycle");
    if (step < 1) diagnostics.error(at_parameter("Step"), "a step is at least one picture");
    if (!(fps > 0)) diagnostics.error(at_parameter("FPS"), "the rate must be above 0");
    if (is_camera()) return;  // whether there is one is known at the start
    if (!fs::exists(file_name, none))
        diagnostics.error(at_parameter("File Name"),
                          fmt::format("there is no film or folder '{}'", file_name),
                          "relative paths start at the folder of the file that names them");
    else if (fs::is_directory(file_name, none)) {
        try {
            open_folder(file_name);
        } catch (const std::exception& e) {
            diagnostics.error(at_parameter("File Name"), e.what(), "pictures have names that end with .png");
        }
    } else if (!fs::is_regular_file(file_name, none))
        diagnostics.error(at_parameter("File Name"),
                          fmt::format("'{}' is neither a film nor a folder", file_name),
                          "a camera is named by DeviceName, with an empty 'File Name'");
}

void VideoModule::open() {
    position_ = 0;
    source_ = is_camera()                                ? open_camera(camera())
              : std::filesystem::is_directory(file_name) ? open_folder(file_name)
                                                         : open_film(file_name);
}

void VideoModule::start(const ModulePorts& ports) {
    for (std::size_t i = 0; i < end_of_video; ++i) shapes_.push_back(ports.outputs[i].shape);
    over_ = false, waited_ = 0, due_ = 0;
    // A camera is opened by the first cycle: when the studio rebuilds a run, the previous run still has it.
    if (is_camera())
        check_camera(camera());
    else
        open();
    begun_ = std::chrono::steady_clock::now();
}

/// The last of the next `pictures` pictures; empty when the end comes before.
std::optional<Picture> VideoModule::take(std::int64_t pictures) {
    for (; pictures > 1; --pictures, ++position_)
        if (!source_->skip()) return std::nullopt;
    auto out = source_->next();
    if (out) ++position_;
    return out;
}

void VideoModule::update(ModuleFrame& frame) {
    if (over_) return;
    if (!source_) open();
    std::optional<Picture> picture;
    std::int64_t wanted = step;
    if (real_time && is_camera()) {
        picture = source_->newest();
        if (!picture) return;
    } else if (real_time) {
        const double elapsed =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
        const auto due = static_cast<std::int64_t>(std::floor(elapsed * fps)) + 1;
        if (due == due_) return;
        wanted = position_ == 0 ? 1 : step * (due - due_);
        due_ = due;
    } else {
        if (waited_ > 0) {
            waited_ = waited_ + 1 < static_cast<std::uint64_t>(cycles_per_picture) ? waited_ + 1 : 0;
            return;
        }
        waited_ = cycles_per_picture > 1 ? 1 : 0;
        if (position_ == 0) wanted = 1;
    }
    bool began_anew = false;
    if (!picture) picture = take(wanted);
    if (!picture && loop && !is_camera()) {
        open();
        began_anew = true;
        picture = take(1);
    }
    over_ = !picture;
    if (frame.is_read(end_of_video)) frame.output(end_of_video).setConstant(over_ || began_anew ? 1 : 0);
    if (picture) return show(*picture, frame);
    for (std::size_t i = 0; i < end_of_video; ++i)
        if (frame.is_read(i)) frame.output(i).setZero();
}

void VideoModule::show(const Picture& picture, ModuleFrame& frame) {
    Cells cells;
    const GroupShape* shape = nullptr;  // of `cells`
    for (std::size_t i = 0; i < end_of_video; ++i) {
        if (!frame.is_read(i)) continue;
        if (!shape || shape->width != shapes_[i].width || shape->height != shapes_[i].height) {
            shape = &shapes_[i];
            cells = resampled(picture, shape->width, shape->height);
            adjust(cells, {brightness, contrast, saturation});
            if (monochrome)
                make_grey(cells);
            else if (hsv)
                make_hsv(cells);
        }
        frame.output(i) = cells.col(static_cast<Eigen::Index>(i));
    }
}

void VideoModule::checkpoint(Archive& archive) {
    std::int64_t position = position_;
    archive(position, over_, waited_);
    if (!archive.loading() || is_camera()) return;
    if (position < position_) open();
    while (position_ < position) {
        if (!source_->skip())
            throw std::runtime_error(
                fmt::format("'{}' has fewer pictures than when the run was saved", file_name));
        ++position_;
    }
}

}  // namespace forage::video
