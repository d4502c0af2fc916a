// Where pictures come from.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "modules/devices/video/picture.h"

namespace forage::video {

/// A sequence of pictures.
class Source {
  public:
    virtual ~Source() = default;
    /// The next picture; empty at the end. Throws std::runtime_error.
    virtual std::optional<Picture> next() = 0;
    /// Skips the next picture. Returns false at the end.
    virtual bool skip() { return next().has_value(); }
    /// The newest picture, if there is one that has not been read yet, without waiting. Only cameras have
    /// one.
    virtual std::optional<Picture> newest() { return std::nullopt; }
};

struct CameraSettings {
    std::string device;
    int width = 160, height = 120;  ///< what the camera is asked for, pixels
    double fps = 25;
};

/// The PNG files in a folder, by name. Throws std::runtime_error when there are none.
std::unique_ptr<Source> open_folder(const std::string& folder);
/// A film, decoded by ffmpeg. Throws std::runtime_error.
std::unique_ptr<Source> open_film(const std::string& file);
/// Throws std::runtime_error when there is no such camera, or no program that reads it. Does not open it.
void check_camera(const CameraSettings& settings);
/// A camera (Video4Linux), read by ffmpeg. Throws std::runtime_error.
std::unique_ptr<Source> open_camera(const CameraSettings& settings);

}  // namespace forage::video
