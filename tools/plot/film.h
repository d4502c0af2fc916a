// A run to look at: the world from above, and what the robots' cameras see, side by side.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bug_interface/simulation/world.h"
#include "tools/plot/gif.h"

namespace forage::plot {

/// Films a world. A name that ends with .gif becomes an animated GIF, one with .png numbered pictures
/// (NAME_00001.png).
class Film {
  public:
    /// `seconds_per_frame`: of the world; it plays at that pace. The world must outlive the film.
    Film(bug::World& world, std::string name, double seconds_per_frame, const std::string& title);
    ~Film();
    /// A frame of the world as it is now. Throws std::runtime_error.
    void add();
    /// Gives the file its name. Returns how many frames there are.
    std::size_t finish();

    static bool is_name(const std::string& name);
    /// The file of a frame, the first is 1, of a film with a name that ends with .png.
    static std::string frame_name(const std::string& name, std::size_t frame);

  private:
    class Screen;
    std::string name_;
    std::unique_ptr<Screen> screen_;
    std::optional<GifFile> gif_;
    std::size_t frames_ = 0;
};

}  // namespace forage::plot
