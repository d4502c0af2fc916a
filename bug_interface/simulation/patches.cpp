#include "bug_interface/simulation/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "bug_interface/world/png.h"

namespace forage::bug {
namespace {

constexpr int longest_side = 512;         // pixels
constexpr double smallest_radius = 0.05;  // m

/// `hue`: 0..180, as in OpenCV's 8-bit pictures.
std::string name_of(int hue) {
    static constexpr std::array names = {"red",  "orange", "yellow", "lime",   "green",   "mint",
                                         "cyan", "azure",  "blue",   "violet", "magenta", "rose"};
    return names[static_cast<std::size_t>((hue + 7) / 15) % names.size()];
}

void add_patches(const Floor& floor, std::vector<Patch>& out) {
    Image image = read_png(floor.texture);
    const cv::Mat picture(image.height, image.width, CV_8UC3, image.rgb.data());
    const double scale = std::min(1.0, double(longest_side) / std::max(image.width, image.height));
    cv::Mat small, hsv, coloured, labels, statistics, middles;
    cv::resize(picture, small, {}, scale, scale, cv::INTER_NEAREST);
    cv::cvtColor(small, hsv, cv::COLOR_RGB2HSV);
    cv::inRange(hsv, cv::Scalar(0, 128, 64), cv::Scalar(180, 255, 255), coloured);
    const int count = cv::connectedComponentsWithStats(coloured, labels, statistics, middles);
    const double width = floor.size_x / small.cols, height = floor.size_y / small.rows;  // of a pixel, m
    for (int i = 1; i < count; ++i) {  // 0 is the background
        const double radius =
            std::sqrt(statistics.at<int>(i, cv::CC_STAT_AREA) * width * height / std::numbers::pi);
        if (radius < smallest_radius) continue;
        const double column = middles.at<double>(i, 0), row = middles.at<double>(i, 1);
        const auto& colour =
            hsv.at<cv::Vec3b>(static_cast<int>(std::lround(row)), static_cast<int>(std::lround(column)));
        out.push_back({{floor.x + (column + 0.5) * width - floor.size_x / 2,
                        floor.y + floor.size_y / 2 - (row + 0.5) * height},
                       radius,
                       name_of(colour[0])});
    }
}

}  // namespace

std::vector<Patch> patches_of(std::span<const Floor> floors) {
    std::vector<Patch> out;
    for (const Floor& floor : floors) add_patches(floor, out);
    return out;
}

int patch_at(std::span<const Patch> patches, const Eigen::Vector2d& place) {
    for (std::size_t i = 0; i < patches.size(); ++i)
        if ((patches[i].middle - place).norm() < patches[i].radius) return static_cast<int>(i);
    return -1;
}

}  // namespace forage::bug
