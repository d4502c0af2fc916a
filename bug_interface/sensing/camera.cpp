// The constant data of a camera (rays, floor points, bounds) and its noise.
#include "bug_interface/sensing/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bug_interface/sensing/normal_table.h"
#include "bug_interface/sensing/solid_ray.h"
#include "core/base/simd.h"

namespace forage::bug {
namespace {

double bottom(const VisualSolid& visual) {
    return visual.solid.pose.translation().z() - half_height(visual.solid);
}

constexpr std::size_t lanes = 8;
typedef float Levels __attribute__((vector_size(lanes * sizeof(float))));  // NOLINT: no `using` for these
typedef std::int32_t Numbers __attribute__((vector_size(lanes * sizeof(int))));  // NOLINT

#if defined(__clang__)
#define FORAGE_LANES(v, ...) __builtin_shufflevector(v, v, __VA_ARGS__)
#else
#define FORAGE_LANES(v, ...) __builtin_shuffle(v, Numbers{__VA_ARGS__})
#endif

/// Adds noise to eight of the 24 values of eight pixels, and converts them to 0..255. `noise` is that of the
/// pixels to which the values belong.
[[gnu::always_inline]] inline void add_noise(const float* values, const Levels& noise, std::int32_t* out) {
    Levels level;
    std::memcpy(&level, values, sizeof level);
    level = 255 * level + noise;
    level = level > 0 ? level : Levels{};
    level = level < 255 ? level : Levels{} + 255;
    const Numbers numbers = __builtin_convertvector(level + 0.5f, Numbers);
    std::memcpy(out, &numbers, sizeof numbers);
}

/// Converts `pixels` pixels, a multiple of eight, to bytes with noise. Two loops are needed: GCC does not
/// vectorise one loop that also converts to bytes.
template <std::size_t pixels>
[[gnu::always_inline]] inline void block_to_bytes(const float* rgb, const std::uint16_t* indices,
                                                  const float* quantiles, float scale, std::uint8_t* out) {
    std::int32_t numbers[3 * pixels];
    for (std::size_t i = 0; i < pixels; i += lanes) {
        Levels z;
        for (std::size_t k = 0; k < lanes; ++k) z[k] = scale * quantiles[indices[i + k]];
        add_noise(rgb + 3 * i, FORAGE_LANES(z, 0, 0, 0, 1, 1, 1, 2, 2), numbers + 3 * i);
        add_noise(rgb + 3 * i + 8, FORAGE_LANES(z, 2, 3, 3, 3, 4, 4, 4, 5), numbers + 3 * i + 8);
        add_noise(rgb + 3 * i + 16, FORAGE_LANES(z, 5, 5, 6, 6, 6, 7, 7, 7), numbers + 3 * i + 16);
    }
    for (std::size_t i = 0; i < 3 * pixels; ++i) out[i] = static_cast<std::uint8_t>(numbers[i]);
}

/// Converts a multiple of eight pixels to bytes with noise. There are no branches, as random noise would make
/// them hard to predict. `indices` has one index per pixel into the table of normal numbers `quantiles`.
FORAGE_SIMD void to_bytes(const float* rgb, const std::uint16_t* indices, const float* quantiles, float scale,
                          std::size_t pixels, std::uint8_t* out) {
    constexpr std::size_t block = 4 * lanes;
    std::size_t i = 0;
    for (; i + block <= pixels; i += block)
        block_to_bytes<block>(rgb + 3 * i, indices + i, quantiles, scale, out + 3 * i);
    for (; i < pixels; i += lanes)
        block_to_bytes<lanes>(rgb + 3 * i, indices + i, quantiles, scale, out + 3 * i);
}

}  // namespace

Camera::Camera(const CameraSensor& sensor, const Pose& link_pose, std::shared_ptr<const Scene> scene,
               int samples_per_axis)
    : scene_(std::move(scene)),
      width_(sensor.width),
      height_(sensor.height),
      samples_(samples_per_axis * samples_per_axis),
      far_(sensor.far),
      noise_(sensor.noise),
      tan_x_(std::tan(sensor.horizontal_fov / 2)),
      tan_y_(tan_x_ * sensor.height / sensor.width),
      mount_(link_pose * sensor.pose) {
    if (samples_per_axis < 1 || samples_ > max_samples)
        throw std::invalid_argument("a camera has 1 to 4 samples per axis");
    make_samples(samples_per_axis);
    make_floor_points();
    double lowest = 0;
    for (const FloorSurface& floor : scene_->floors()) lowest = std::min(lowest, floor.z);
    for (const VisualSolid& solid : scene_->solids()) lowest = std::min(lowest, bottom(solid));
    all_ = bounds(lowest, std::numeric_limits<double>::infinity());
    low_ = bounds(lowest, low_height);
    make_extents();
    std::vector<Area> areas;
    for (const VisualSolid& visual : scene_->solids()) areas.push_back(area_of(visual.solid));
    solids_.assign(areas, 2);
    cover_.resize(blocks_.size()), own_blocks_.assign(blocks_.size(), -1);
    reserve();
}

void Camera::reserve() {
    const std::size_t solids = scene_->solids().size();
    near_.reserve(solids), windows_.reserve(solids + 64);
    reach_.reserve(static_cast<std::size_t>(height_));
    spans_.reserve(windows_.capacity() * static_cast<std::size_t>(height_));
    colours_.reserve(1 + faces * windows_.capacity());
}

Eigen::Vector3d Camera::ray(double column, double row) const {
    const double left = (1 - 2 * column / width_) * tan_x_, up = (1 - 2 * row / height_) * tan_y_;
    return mount_.linear() * Eigen::Vector3d(1, left, up);
}

void Camera::make_samples(int samples_per_axis) {
    blocks_wide_ = static_cast<std::size_t>((width_ + block_width - 1) / block_width);
    block_samples_ = static_cast<std::size_t>(block_width * samples_);
    for (int row = 0; row < height_; ++row)
        for (int column = 0; column < width_; column += block_width)
            for (int s = 0; s < samples_; ++s)
                for (int p = 0; p < block_width; ++p) {
                    const Eigen::Vector3d r =
                        ray(column + p + (s % samples_per_axis + 0.5) / samples_per_axis,
                            row + (s / samples_per_axis + 0.5) / samples_per_axis);
                    ray_x_.push_back(static_cast<float>(r.x()));
                    ray_y_.push_back(static_cast<float>(r.y()));
                    ray_z_.push_back(static_cast<float>(r.z()));
                }
}

void Camera::make_floor_points() {
    constexpr float beyond = std::numeric_limits<float>::infinity();
    for (const FloorSurface& floor : scene_->floors()) {
        FloorPoints points;
        for (std::size_t k = 0; k < ray_x_.size(); ++k) {
            const double depth = (floor.z - mount_.translation().z()) / ray_z_[k];
            const bool met = ray_z_[k] < 0 && depth > 0 && depth <= far_;
            points.x.push_back(met ? static_cast<float>(mount_.translation().x() + depth * ray_x_[k])
                                   : beyond);
            points.y.push_back(met ? static_cast<float>(mount_.translation().y() + depth * ray_y_[k])
                                   : beyond);
            points.depth.push_back(met ? static_cast<float>(depth) : beyond);
        }
        floor_points_.push_back(std::move(points));
    }
}

void Camera::make_extents() {
    const auto extent = [&](std::size_t first, std::size_t count) {
        Eigen::AlignedBox2f box;
        Extent out;
        for (std::size_t k = first; k < first + count; ++k) {
            for (const FloorPoints& floor : floor_points_)
                out.reaches_floor &= floor.depth[k] < std::numeric_limits<float>::infinity();
            if (floor_points_.size() == 1)
                box.extend(Eigen::Vector2f(floor_points_.front().x[k], floor_points_.front().y[k]));
        }
        const Eigen::Vector2f middle = box.center(), half = box.sizes() / 2;
        out.x = middle.x(), out.y = middle.y(), out.half_x = half.x(), out.half_y = half.y();
        return out;
    };
    const std::size_t in_row = blocks_wide_ * block_samples_;
    for (std::size_t first = 0; first < ray_x_.size(); first += block_samples_) {
        blocks_.push_back(extent(first, block_samples_));
        nearest_floor_.push_back(std::numeric_limits<float>::infinity());
        for (const FloorPoints& floor : floor_points_)
            for (std::size_t k = first; k < first + block_samples_; ++k)
                nearest_floor_.back() = std::min(nearest_floor_.back(), floor.depth[k]);
    }
    for (std::size_t first = 0; first < ray_x_.size(); first += in_row)
        rows_.push_back(extent(first, in_row));
    whole_ = extent(0, ray_x_.size());
}

/// Bounds of all points that the samples can see between the heights `lowest` and `highest`, m.
Camera::Bounds Camera::bounds(double lowest, double highest) const {
    const Eigen::Vector3d eye = mount_.translation();
    const auto down_to = [&](std::size_t k, double z) -> Eigen::Vector3d {
        const double depth = eye.z() <= z    ? 0.0
                             : ray_z_[k] < 0 ? std::min(far_, (z - eye.z()) / ray_z_[k])
                                             : far_;
        return eye + depth * Eigen::Vector3d(ray_x_[k], ray_y_[k], ray_z_[k]);
    };
    const auto last = [&](std::size_t k) -> Eigen::Vector3d {  // a camera below all solids may look up
        return eye.z() <= lowest ? eye + far_ * Eigen::Vector3d(ray_x_[k], ray_y_[k], ray_z_[k])
                                 : down_to(k, lowest);
    };
    Eigen::AlignedBox3d box;
    for (std::size_t k = 0; k < ray_x_.size(); ++k) box.extend(down_to(k, highest)).extend(last(k));
    Bounds out{box, box.center(), 0};
    for (std::size_t k = 0; k < ray_x_.size(); ++k)
        for (const Eigen::Vector3d& end : {down_to(k, highest), last(k)})
            out.radius = std::max(out.radius, (end - out.centre).norm());
    return out;
}

Area Camera::view_area(const Pose2& robot) const {
    const Eigen::Vector3d middle = all_.box.center(), half = all_.box.sizes() / 2;
    const double c = std::cos(robot.yaw), s = std::sin(robot.yaw);
    const double x = robot.x + c * middle.x() - s * middle.y(), y = robot.y + s * middle.x() + c * middle.y();
    constexpr double margin = 1e-6;
    const double half_x = std::abs(c) * half.x() + std::abs(s) * half.y() + margin,
                 half_y = std::abs(s) * half.x() + std::abs(c) * half.y() + margin;
    return {x - half_x, y - half_y, x + half_x, y + half_y};
}

std::optional<Eigen::Vector2d> Camera::floor_point(int column, int row) const {
    const Eigen::Vector3d r = ray(column + 0.5, row + 0.5), eye = mount_.translation();
    if (r.z() >= 0 || eye.z() <= 0) return {};
    return Eigen::Vector2d(eye.head<2>() - eye.z() / r.z() * r.head<2>());
}

void Camera::quantise(std::span<const float> rgb, std::span<std::uint8_t> out, const RandomStream& random,
                      std::uint64_t sample) const {
    constexpr std::size_t block_pixels = 1024;
    const float scale = static_cast<float>(255 * noise_);
    const std::size_t pixels = rgb.size() / 3, blocks = (pixels + block_pixels - 1) / block_pixels;
    std::array<std::uint64_t, block_pixels / 4> words{};
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::size_t first = block * block_pixels, count = std::min(block_pixels, pixels - first);
        // A word of 64 random bits gives the indices of four pixels into the table of normal numbers.
        if (noise_ > 0) random.bits(sample * blocks + block, std::span(words).first((count + 3) / 4));
        std::array<std::uint16_t, block_pixels> indices;
        std::memcpy(indices.data(), words.data(), sizeof indices);
        const std::size_t whole = count / lanes * lanes, rest = count - whole;
        const float* from = &rgb[3 * first];
        std::uint8_t* to = &out[3 * first];
        to_bytes(from, indices.data(), normal_quantiles().data(), scale, whole, to);
        if (rest == 0) continue;
        std::array<float, 3 * lanes> last{};
        std::array<std::uint8_t, 3 * lanes> bytes;
        std::copy_n(from + 3 * whole, 3 * rest, last.begin());
        to_bytes(last.data(), &indices[whole], normal_quantiles().data(), scale, lanes, bytes.data());
        std::copy_n(bytes.begin(), 3 * rest, to + 3 * whole);
    }
}

}  // namespace forage::bug
