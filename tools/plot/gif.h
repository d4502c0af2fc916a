// Animated GIF files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct GifFileType;

namespace forage::plot {

/// The pixels of a picture, which remain cairo's: 0x??RRGGBB.
struct Pixels {
    int width = 0, height = 0;
    std::size_t stride = 0;  ///< from row to row, in pixels
    const std::uint32_t* rgb = nullptr;
};

/// Writes an animated GIF that repeats forever, frame by frame. The colours are from a fixed table (6 x 6 x 6
/// colours and 39 greys), so that the same frames give the same bytes. Only the rectangle of a frame that has
/// changed is written, and what has not changed in it is transparent, which compresses best. The file is
/// called NAME.part until finish(); without frames, no file remains. Functions throw std::runtime_error when
/// the file cannot be written.
class GifFile {
  public:
    GifFile(std::string name, double seconds_per_frame);
    ~GifFile();
    GifFile(const GifFile&) = delete;
    GifFile& operator=(const GifFile&) = delete;

    /// Adds a frame. All frames must have the size of the first one.
    void add(const Pixels& frame);
    /// Completes the file and renames it to NAME.
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
    std::vector<std::uint32_t> rgb_;     ///< the last frame
    std::vector<std::uint8_t> numbers_;  ///< its colour numbers
    std::vector<std::uint8_t> changes_;  ///< the numbers that have changed; the others are transparent
};

}  // namespace forage::plot
