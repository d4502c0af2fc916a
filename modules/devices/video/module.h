// moduleVideo: pictures of a camera, a film or a folder as the activity of groups.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/types/module.h"
#include "modules/devices/video/source.h"

namespace forage::video {

/// Shows one picture after another to its groups. In lock-step, which is the default, a picture lasts a
/// number of cycles, so that the run depends on nothing but the pictures; in real time, the clock decides.
class VideoModule {
  public:
    static void describe(ModuleSpec<VideoModule>& s);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive& archive);

  private:
    void open();
    bool is_camera() const { return file_name.empty(); }
    CameraSettings camera() const { return {device, image_width, image_height, fps}; }
    std::optional<Picture> take(std::int64_t pictures);
    void show(const Picture& picture, ModuleFrame& frame);

    std::string device = "/dev/video0", file_name;
    int image_width = 160, image_height = 120;
    double fps = 25;
    double brightness = 50, contrast = 50, saturation = 50;
    bool hsv = false, monochrome = false;
    bool real_time = false, loop = true;
    int cycles_per_picture = 1, step = 1;
    // These have no effect.
    int input = 0, standard = 0, auto_gain = 0;
    bool info_window = false, show_output = false;

    std::unique_ptr<Source> source_;  ///< null until a camera is opened
    std::vector<GroupShape> shapes_;
    std::int64_t position_ = 0;  ///< number of pictures that the source has given since its beginning
    bool over_ = false;          ///< whether there are no more pictures
    std::uint64_t waited_ = 0;   ///< cycles since the last picture, in lock-step
    std::int64_t due_ = 0;       ///< number of pictures that were due since begun_, in real time
    std::chrono::steady_clock::time_point begun_{};
};

}  // namespace forage::video
