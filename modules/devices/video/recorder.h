// moduleVideoRecorder: the activity of groups as a film.
#pragma once

#include <ostream>

#include "core/types/module.h"
#include "modules/devices/video/picture.h"

namespace forage::video {

/// Writes the activity of one group in grey, or of three in colours, into a film without compression
/// (YUV4MPEG2), which ffmpeg and most players read. A resumed run continues it.
class RecorderModule {
  public:
    static void describe(ModuleSpec<RecorderModule>& s);
    void check(const ModulePorts& ports, Diagnostics& diagnostics) const;
    void start(const ModulePorts& ports);
    void update(ModuleFrame& frame);
    void checkpoint(Archive&) {}

  private:
    int fps = 25, scale = 1, every = 1;
    double minimum = 0, maximum = 1;
    bool hsv = false;

    std::ostream* file_ = nullptr;
    GroupShape shape_;
    bool colours_ = false;
};

}  // namespace forage::video
