// GIF files: moving pictures that every viewer shows.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct GifFileType;

namespace forage::plot {

/// Pixels of a picture, 4 bytes each as cairo has them: 0x00RRGGBB.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> rgb;
};

/// Writes an animated GIF, frame by frame, that repeats for ever. Colours are those of a fixed table of 256
/// (6 x 6 x 6 and 40 greys), so that the same frames give the same bytes; of every frame only the rectangle
/// that changed is written. While it grows it is called NAME.part; without a frame nothing is left behind.
/// Throws std::runtime_error.
class GifFile {
  public:
    GifFile(std::string name, double seconds_per_frame);
    ~GifFile();
    GifFile(const GifFile&) = delete;
    GifFile& operator=(const GifFile&) = delete;

    /// All frames have the size of the first.
    void add(const Pixels& frame);
    /// Gives the file its name.
    void finish();
    std::size_t frames() const { return frames_; }

  private:
    void begin(const Pixels& frame);
    void check(bool good) const;

    std::string name_;
    int hundredths_;
    GifFileType* file_ = nullptr;
    int width_ = 0, height_ = 0;
    std::size_t frames_ = 0;
    std::vector<std::uint8_t> before_, now_;  ///< numbers of colours
};

}  // namespace forage::plot
