#include "tools/plot/gif.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <gif_lib.h>

namespace forage::plot {
namespace {

constexpr int transparent = 255;

GifColorType from_rgb(std::uint32_t rgb) {
    const auto byte = [rgb](int shift) { return static_cast<GifByteType>(rgb >> shift & 255); };
    return {byte(16), byte(8), byte(0)};
}

/// 6 x 6 x 6 colours, and greys.
std::vector<std::uint32_t> film_colours() {
    constexpr std::uint32_t cube = 6, greys = transparent - cube * cube * cube;
    const auto level = [](std::uint32_t i, std::uint32_t steps) { return (i * 255 + steps / 2) / steps; };
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < cube * cube * cube; ++i)
        out.push_back(level(i / (cube * cube), cube - 1) << 16 | level(i / cube % cube, cube - 1) << 8 |
                      level(i % cube, cube - 1));
    for (std::uint32_t i = 1; i <= greys; ++i) out.push_back(level(i, greys + 1) * 0x010101);
    return out;
}

int in_hundredths(double seconds) { return std::max(2, static_cast<int>(std::lround(100 * seconds))); }

int append_bytes(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<std::string*>(file->UserData)
        ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
}

}  // namespace

GifFile::GifFile(std::string name, double seconds_per_frame)
    : name_(std::move(name)), colours_(film_colours()), hundredths_(in_hundredths(seconds_per_frame)) {}

GifFile::GifFile(std::string* content, double seconds_per_frame, std::vector<std::uint32_t> colours)
    : name_("an animation"),
      content_(content),
      colours_(std::move(colours)),
      hundredths_(in_hundredths(seconds_per_frame)) {}

GifFile::~GifFile() {
    if (!file_) return;
    EGifCloseFile(file_, nullptr);
    if (!content_) std::remove((name_ + ".part").c_str());
}

void GifFile::check(bool good) const {
    if (!good) throw std::runtime_error(fmt::format("cannot write '{}'", name_));
}

void GifFile::begin(const Pixels& frame) {
    int error = 0;
    if (content_) {
        file_ = EGifOpen(content_, append_bytes, &error);
    } else {  // giflib itself makes files that only their owner can read
        const int part = ::open((name_ + ".part").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        check(part >= 0);
        file_ = EGifOpenFileHandle(part, &error);
    }
    check(file_ != nullptr);
    width_ = frame.width, height_ = frame.height;
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    rgb_.resize(pixels), numbers_.resize(pixels), changes_.assign(pixels, transparent);
    EGifSetGifVersion(file_, true);
    std::array<GifColorType, 256> table{};
    std::ranges::transform(colours_, table.begin(), from_rgb);
    const std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)> colours(
        GifMakeMapObject(256, table.data()), GifFreeMapObject);
    check(colours && EGifPutScreenDesc(file_, width_, height_, 8, 0, colours.get()) == GIF_OK);
    const std::array<GifByteType, 3> for_ever = {1, 0, 0};
    check(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
          EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0") == GIF_OK &&
          EGifPutExtensionBlock(file_, 3, for_ever.data()) == GIF_OK &&
          EGifPutExtensionTrailer(file_) == GIF_OK);
}

std::uint8_t GifFile::number_of(std::uint32_t rgb) {
    rgb &= 0xFFFFFF;
    const auto [at, added] = nearest_.try_emplace(rgb);
    if (added) {
        const auto away = [rgb](std::uint32_t other) {
            int sum = 0;
            for (const int shift : {0, 8, 16}) {
                const int d = static_cast<int>(rgb >> shift & 255) - static_cast<int>(other >> shift & 255);
                sum += d * d;
            }
            return sum;
        };
        const auto nearest =
            std::ranges::min_element(colours_, [&](auto a, auto b) { return away(a) < away(b); });
        at->second = static_cast<std::uint8_t>(nearest - colours_.begin());
    }
    return at->second;
}

void GifFile::add(const Pixels& frame) {
    if (!file_) begin(frame);
    if (frame.width != width_ || frame.height != height_)
        throw std::runtime_error("the frames of a film differ in size");
    const auto width = static_cast<std::size_t>(width_);
    int left = width_, top = height_, right = 0, bottom = 0;  // of the rectangle that has changed
    std::uint32_t last = 0;
    std::uint8_t number = number_of(last);
    for (int y = 0; y < height_; ++y) {
        const std::uint32_t* row = frame.rgb + static_cast<std::size_t>(y) * frame.stride;
        const std::size_t begin = static_cast<std::size_t>(y) * width;
        for (int x = 0; x < width_;) {
            constexpr int chunk = 32;  // most of them are as before
            const int end = std::min(x + chunk, width_);
            std::uint32_t* before = &rgb_[begin + static_cast<std::size_t>(x)];
            const auto bytes = static_cast<std::size_t>(end - x) * sizeof *row;
            if (frames_ > 0 && std::memcmp(row + x, before, bytes) == 0) {
                x = end;
                continue;
            }
            for (; x < end; ++x, ++before) {
                if (frames_ > 0 && row[x] == *before) continue;
                *before = row[x];
                if (row[x] != last) number = number_of(last = row[x]);
                const std::size_t i = begin + static_cast<std::size_t>(x);
                if (frames_ > 0 && number == numbers_[i]) continue;
                numbers_[i] = changes_[i] = number;
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = y;
            }
        }
    }
    if (left > right) left = right = top = bottom = 0;  // a frame has at least one pixel
    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_DO_NOT, control.DelayTime = hundredths_,
    control.TransparentColor = transparent;
    std::array<GifByteType, 4> bytes{};
    EGifGCBToExtension(&control, bytes.data());
    check(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, 4, bytes.data()) == GIF_OK &&
          EGifPutImageDesc(file_, left, top, right - left + 1, bottom - top + 1, false, nullptr) == GIF_OK);
    for (int y = top; y <= bottom; ++y) {
        std::uint8_t* row = &changes_[static_cast<std::size_t>(y) * width];
        check(EGifPutLine(file_, row + left, right - left + 1) == GIF_OK);
        std::fill(row + left, row + right + 1, std::uint8_t{transparent});
    }
    ++frames_;
}

void GifFile::finish() {
    if (!file_) return;
    int error = 0;
    GifFileType* file = file_;
    file_ = nullptr;
    check(EGifCloseFile(file, &error) == GIF_OK &&
          (content_ || std::rename((name_ + ".part").c_str(), name_.c_str()) == 0));
}

}  // namespace forage::plot
