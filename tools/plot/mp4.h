// Films as MP4 files, which the program ffmpeg writes.
#pragma once

#include <string>

#include "tools/plot/gif.h"

namespace forage::plot {

/// Whether ffmpeg is in one of the folders of PATH.
bool has_ffmpeg();

/// Writes a film, frame by frame, through a process of ffmpeg. The file is called NAME.part until finish();
/// without frames, or without finish(), no file remains. Functions throw std::runtime_error when ffmpeg
/// cannot be started or fails.
class Mp4File {
  public:
    Mp4File(std::string name, double seconds_per_frame)
        : name_(std::move(name)), seconds_per_frame_(seconds_per_frame) {}
    ~Mp4File();
    Mp4File(const Mp4File&) = delete;
    Mp4File& operator=(const Mp4File&) = delete;

    /// Adds a frame. All frames must have the size of the first one.
    void add(const Pixels& frame);
    /// Completes the file and renames it to NAME.
    void finish();

  private:
    void start(const Pixels& frame);
    bool end();  ///< closes the pipe and waits for ffmpeg; returns whether it succeeded

    std::string name_;
    double seconds_per_frame_;
    int process_ = -1, socket_ = -1;
};

}  // namespace forage::plot
