#include "modules/devices/video/source.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "bug_interface/world/png.h"
#include "modules/devices/video/child_process.h"
#include "modules/devices/video/ppm.h"

namespace forage::video {
namespace {

namespace fs = std::filesystem;

constexpr int longest_wait = 10000;  // ms, for a picture

class Folder final : public Source {
  public:
    explicit Folder(const std::string& folder) {
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().extension() == ".png")
                files_.push_back(entry.path().string());
        std::ranges::sort(files_);
        if (files_.empty())
            throw std::runtime_error(fmt::format("the folder '{}' has no .png files", folder));
    }
    std::optional<Picture> next() override {
        if (at_ == files_.size()) return std::nullopt;
        bug::Image image = bug::read_png(files_[at_++], 0);
        Picture out{image.width, image.height, {}};
        out.rgb.reserve(3 * image.pixels.size());
        for (const std::uint32_t p : image.pixels)
            for (const int shift : {0, 8, 16}) out.rgb.push_back(static_cast<std::uint8_t>(p >> shift));
        return out;
    }
    bool skip() override { return at_ < files_.size() && (++at_, true); }

  private:
    std::vector<std::string> files_;
    std::size_t at_ = 0;
};

/// The pictures that ffmpeg writes.
class Decoded final : public Source {
  public:
    Decoded(std::string name, const std::vector<std::string>& input)
        : name_(std::move(name)), process_(command(input)) {}

    std::optional<Picture> next() override {
        for (;;) {
            if (auto picture = stream_.next()) return found_ = true, picture;
            if (ended_) return check_end(), std::nullopt;
            const auto bytes = process_.read(longest_wait);
            if (!bytes)
                throw std::runtime_error(
                    fmt::format("'{}' gave no picture for {} s", name_, longest_wait / 1000));
            add(*bytes);
        }
    }
    std::optional<Picture> newest() override {
        while (!ended_) {
            const auto bytes = process_.read(0);
            if (!bytes) break;
            add(*bytes);
        }
        std::optional<Picture> out;
        while (auto picture = stream_.next()) found_ = true, out = std::move(picture);
        if (!out && ended_) throw std::runtime_error(fmt::format("'{}' gives no more pictures", name_));
        return out;
    }

  private:
    static std::vector<std::string> command(const std::vector<std::string>& input) {
        std::vector<std::string> out{"ffmpeg", "-nostdin", "-v", "fatal"};
        out.insert(out.end(), input.begin(), input.end());
        // Without these flags, a processor decides by which code colours are converted, and so their bits.
        // Each picture of the film is one here, whatever its time.
        for (const char* word :
             {"-map", "0:v:0", "-vsync", "passthrough", "-sws_flags", "bicubic+accurate_rnd+bitexact", "-f",
              "image2pipe", "-c:v", "ppm", "pipe:1"})
            out.emplace_back(word);
        return out;
    }
    void add(const std::string& bytes) {
        stream_.add(bytes);
        ended_ = bytes.empty();
    }
    /// A program that fails does not end a film.
    void check_end() {
        const bool good = process_.succeeded() && stream_.empty();
        if (!found_) throw std::runtime_error(fmt::format("ffmpeg finds no pictures in '{}'", name_));
        if (!good) throw std::runtime_error(fmt::format("ffmpeg cannot read '{}' to its end", name_));
    }

    std::string name_;
    ChildProcess process_;
    PpmStream stream_;
    bool ended_ = false, found_ = false;
};

}  // namespace

std::unique_ptr<Source> open_folder(const std::string& folder) { return std::make_unique<Folder>(folder); }

std::unique_ptr<Source> open_film(const std::string& file) {
    // Other formats draw texts, or are lists of files.
    const std::string formats =
        "mp4,matroska,avi,mpeg,mpegts,mpegvideo,ogg,flv,asf,nut,gif,apng,yuv4mpegpipe,mjpeg,h264,hevc,m4v,"
        "ivf,png_pipe,jpeg_pipe,bmp_pipe,ppm_pipe,tiff_pipe,webp_pipe,image2";
    // A film may name others, which ffmpeg would fetch from anywhere.
    return std::make_unique<Decoded>(
        file, std::vector<std::string>{"-protocol_whitelist", "file,pipe", "-format_whitelist", formats, "-i",
                                       "file:" + fs::absolute(file).string()});
}

void check_camera(const CameraSettings& s) {
    if (access(s.device.c_str(), R_OK) != 0)
        throw std::runtime_error(
            fs::exists(s.device)
                ? fmt::format("the camera '{}' cannot be read: the group 'video' may", s.device)
                : fmt::format(
                      "there is no camera '{}'; 'File Name' plays a film or a folder of pictures instead",
                      s.device));
    const ChildProcess answers({"ffmpeg", "-version"});
}

std::unique_ptr<Source> open_camera(const CameraSettings& s) {
    return std::make_unique<Decoded>(
        s.device,
        std::vector<std::string>{"-f", "v4l2", "-framerate", fmt::format("{}", s.fps), "-video_size",
                                 fmt::format("{}x{}", s.width, s.height), "-i", s.device});
}

}  // namespace forage::video
