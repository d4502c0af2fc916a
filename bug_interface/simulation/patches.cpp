#include "bug_interface/simulation/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace forage::bug {
namespace {

constexpr int max_side = 512;        ///< pixels
constexpr double min_radius = 0.05;  ///< m

/// The name of a hue in 0..180, as in OpenCV's 8-bit pictures.
std::string name_of(int hue) {
    static constexpr std::array names = {"red",  "orange", "yellow", "lime",   "green",   "mint",
                                         "cyan", "azure",  "blue",   "violet", "magenta", "rose"};
    return names[static_cast<std::size_t>((hue + 7) / 15) % names.size()];
}

/// The picture of a floor (red, green, blue), reduced to max_side by leaving out pixels.
cv::Mat reduced_picture(const FloorTexture& floor) {
    const double scale = std::min(1.0, double(max_side) / std::max(floor.width(), floor.height()));
    cv::Mat out(std::max(1, static_cast<int>(std::lround(floor.height() * scale))),
                std::max(1, static_cast<int>(std::lround(floor.width() * scale))), CV_8UC3);
    for (int row = 0; row < out.rows; ++row) {
        const std::uint32_t* in = floor.row(std::min(floor.height() - 1, static_cast<int>(row / scale)));
        for (int column = 0; column < out.cols; ++column) {
            const std::uint32_t colour = in[std::min(floor.width() - 1, static_cast<int>(column / scale))];
            out.at<cv::Vec3b>(row, column) = {static_cast<std::uint8_t>(colour),
                                              static_cast<std::uint8_t>(colour >> 8),
                                              static_cast<std::uint8_t>(colour >> 16)};
        }
    }
    return out;
}

void add_patches(const FloorSurface& floor, std::vector<Patch>& out) {
    const cv::Mat small = reduced_picture(floor.texture);
    cv::Mat hsv, coloured, labels, statistics, centres;
    cv::cvtColor(small, hsv, cv::COLOR_RGB2HSV);
    cv::inRange(hsv, cv::Scalar(0, 128, 64), cv::Scalar(180, 255, 255), coloured);
    const int count = cv::connectedComponentsWithStats(coloured, labels, statistics, centres);
    const double width = floor.size_x / small.cols, height = floor.size_y / small.rows;  // of a pixel, m
    for (int i = 1; i < count; ++i) {  // 0 is the background
        const double radius =
            std::sqrt(statistics.at<int>(i, cv::CC_STAT_AREA) * width * height / std::numbers::pi);
        if (radius < min_radius) continue;
        const double column = centres.at<double>(i, 0), row = centres.at<double>(i, 1);
        const auto& colour =
            hsv.at<cv::Vec3b>(static_cast<int>(std::lround(row)), static_cast<int>(std::lround(column)));
        const Eigen::Vector2d on_floor((column + 0.5) * width - floor.size_x / 2,
                                       floor.size_y / 2 - (row + 0.5) * height);
        out.push_back(
            {Eigen::Vector2d(floor.pose.x, floor.pose.y) + Eigen::Rotation2Dd(floor.pose.yaw) * on_floor,
             radius, name_of(colour[0])});
    }
}

}  // namespace

std::vector<Patch> patches_of(std::span<const FloorSurface> floors) {
    std::vector<Patch> out;
    for (const FloorSurface& floor : floors) add_patches(floor, out);
    return out;
}

int patch_at(std::span<const Patch> patches, const Eigen::Vector2d& point) {
    for (std::size_t i = 0; i < patches.size(); ++i)
        if ((patches[i].centre - point).norm() < patches[i].radius) return static_cast<int>(i);
    return -1;
}

}  // namespace forage::bug
