// A stream of pictures in the format PPM, as ffmpeg writes it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "modules/devices/video/picture.h"

namespace forage::video {

/// Collects bytes and takes pictures from them. A picture is "P6", width, height, "255", one blank, and the
/// pixels.
class PpmStream {
  public:
    void add(std::string_view bytes) { bytes_ += bytes; }
    /// The next complete picture; empty when more bytes are needed. Throws std::runtime_error when the bytes
    /// are not a picture of at most 4096 x 4096 pixels.
    std::optional<Picture> next();
    bool empty() const { return at_ == bytes_.size(); }  ///< whether no byte of a further picture is there

  private:
    std::string bytes_;
    std::size_t at_ = 0;  ///< where the next picture begins
};

}  // namespace forage::video
