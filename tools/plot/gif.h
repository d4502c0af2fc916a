// Animated GIF files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

struct GifFileType;

namespace forage::plot {

/// The pixels of a picture, which remain cairo's: 0x??RRGGBB.
struct Pixels {
    int width = 0, height = 0;
    std::size_t stride = 0;  ///< from row to row, in pixels
    const std::uint32_t* rgb = nullptr;
};

/// Writes an animated GIF that repeats forever, frame by frame. The colours are from a fixed table, so that
/// the same frames give the same bytes. Only the rectangle of a frame that has changed is written, and what
/// has not changed in it is transparent, which compresses best. The file is called NAME.part until finish();
/// without frames, no file remains. Functions throw std::runtime_error when the file cannot be written or the
/// frames differ in size.
class GifFile {
  public:
    /// The table has 6 x 6 x 6 colours and 39 greys.
    GifFile(std::string name, double seconds_per_frame);
    /// Appends the file to `content`, which must live until finish(). The table has at most 255 `colours`.
    GifFile(std::string* content, double seconds_per_frame, std::vector<std::uint32_t> colours);
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
    std::uint8_t number_of(std::uint32_t rgb);
    void check(bool good) const;

    std::string name_;
    std::string* content_ = nullptr;
    std::vector<std::uint32_t> colours_;                       ///< of the table
    std::unordered_map<std::uint32_t, std::uint8_t> nearest_;  ///< the numbers of colours that were looked up
    int hundredths_;
    GifFileType* file_ = nullptr;
    int width_ = 0, height_ = 0;
    std::size_t frames_ = 0;
    std::vector<std::uint32_t> rgb_;     ///< the last frame
    std::vector<std::uint8_t> numbers_;  ///< its colour numbers
    std::vector<std::uint8_t> changes_;  ///< the numbers that have changed; the others are transparent
};

}  // namespace forage::plot
