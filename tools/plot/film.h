// Films of a run: the world from above and the pictures of the robots' cameras, side by side.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "core/base/diagnostic.h"
#include "tools/plot/film_groups.h"
#include "tools/plot/gif.h"
#include "tools/plot/mp4.h"

namespace forage::plot {

/// Films a world: as an animated GIF when the name ends with .gif, as a film of ffmpeg when it ends with
/// .mp4, as numbered pictures (NAME_00001.png) when it ends with .png, and only by draw() when it is empty.
class Film {
  public:
    /// `seconds_per_frame` is the simulated time between two frames; the film is played at this rate. `world`
    /// must outlive the film. The film shows the values that were last read into groups().
    Film(bug::World& world, std::string name, double seconds_per_frame, std::string title,
         std::vector<observe::Source> groups = {});
    ~Film();
    /// Draws the current state of the world, without adding a frame. Valid until the next call.
    Pixels draw();
    /// Adds a frame with the current state of the world. Throws std::runtime_error when it cannot be written.
    void add();
    /// Completes the file. Returns the number of frames.
    std::size_t finish();

    FilmGroups& groups() { return groups_; }
    const FilmGroups& groups() const { return groups_; }

    /// Reports a name of a film that does not end with .gif, .mp4 or .png, and one of ffmpeg where ffmpeg is
    /// missing. `option` begins the message.
    static void check_name(const std::string& name, const std::string& option, Diagnostics& diagnostics);
    /// The file name of a frame (counted from 1) of a film whose name ends with .png.
    static std::string frame_name(const std::string& name, std::size_t frame);

  private:
    class Screen;
    bug::World& world_;
    std::string name_, title_;
    FilmGroups groups_;
    std::unique_ptr<Screen> screen_;
    std::optional<GifFile> gif_;
    std::optional<Mp4File> mp4_;
    std::size_t frames_ = 0;
};

}  // namespace forage::plot
