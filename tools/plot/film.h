// Films of a run: the world from above and the pictures of the robots' cameras, side by side.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bug_interface/simulation/world.h"
#include "tools/plot/gif.h"

namespace forage::plot {

/// Films a world: as an animated GIF when the name ends with .gif, as numbered pictures (NAME_00001.png)
/// when it ends with .png, and only by draw() when it is empty.
class Film {
  public:
    /// `seconds_per_frame` is the simulated time between two frames; the film is played at this rate. `world`
    /// must outlive the film.
    Film(bug::World& world, std::string name, double seconds_per_frame, std::string title);
    ~Film();
    /// Draws the current state of the world, without adding a frame. Valid until the next call.
    Pixels draw();
    /// Adds a frame with the current state of the world. Throws std::runtime_error when it cannot be written.
    void add();
    /// Completes the file. Returns the number of frames.
    std::size_t finish();

    /// Whether a name ends with .gif or .png.
    static bool is_name(const std::string& name);
    /// The file name of a frame (counted from 1) of a film whose name ends with .png.
    static std::string frame_name(const std::string& name, std::size_t frame);

  private:
    class Screen;
    bug::World& world_;
    std::string name_, title_;
    std::unique_ptr<Screen> screen_;
    std::optional<GifFile> gif_;
    std::size_t frames_ = 0;
};

}  // namespace forage::plot
