// The constant data of a camera (rays, floor points, bounds of the tiles) and its noise.
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
    make_bounds(lowest);
    if (floor_points_.size() == 1) make_extents();
    windows_.reserve(scene_->solids().size() + 64);
}

Eigen::Vector3d Camera::ray(double column, double row) const {
    const double left = (1 - 2 * column / width_) * tan_x_, up = (1 - 2 * row / height_) * tan_y_;
    return mount_.linear() * Eigen::Vector3d(1, left, up);
}

void Camera::make_samples(int samples_per_axis) {
    for (int row = 0; row < height_; ++row)
        for (int column = 0; column < width_; column += tile_width) {
            Tile tile;
            tile.row = row, tile.column = column, tile.pixels = std::min(tile_width, width_ - column);
            tile.first = ray_x_.size();
            tiles_.push_back(tile);
            for (int s = 0; s < samples_; ++s)
                for (int p = 0; p < tile.pixels; ++p) {
                    const Eigen::Vector3d r =
                        ray(column + p + (s % samples_per_axis + 0.5) / samples_per_axis,
                            row + (s / samples_per_axis + 0.5) / samples_per_axis);
                    ray_x_.push_back(static_cast<float>(r.x()));
                    ray_y_.push_back(static_cast<float>(r.y()));
                    ray_z_.push_back(static_cast<float>(r.z()));
                }
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
        for (Tile& tile : tiles_)
            for (int k = 0; k < tile.pixels * samples_; ++k)
                tile.reaches_floor &= points.depth[tile.first + static_cast<std::size_t>(k)] < beyond;
        floor_points_.push_back(std::move(points));
    }
}

Camera::Extent Camera::extent(const Tile& tile, int first_pixel, int pixels) const {
    Eigen::AlignedBox2f box;
    for (int s = 0; s < samples_; ++s)
        for (int p = first_pixel; p < first_pixel + pixels; ++p) {
            const std::size_t k = tile.first + static_cast<std::size_t>(s * tile.pixels + p);
            box.extend(Eigen::Vector2f(floor_points_.front().x[k], floor_points_.front().y[k]));
        }
    return extent(box);
}

Camera::Extent Camera::extent(const Eigen::AlignedBox2f& box) {
    const Eigen::Vector2f middle = box.center(), half = box.sizes() / 2;
    return {middle.x(), middle.y(), half.x(), half.y()};
}

void Camera::make_extents() {
    Eigen::AlignedBox2f all;
    for (Tile& tile : tiles_) {
        tile.extent = extent(tile, 0, tile.pixels);
        for (int first = 0; first < tile.pixels; first += segment_width)
            tile.segments[static_cast<std::size_t>(first / segment_width)] =
                extent(tile, first, std::min(segment_width, tile.pixels - first));
        whole_.reaches_floor &= tile.reaches_floor;
        const Extent& e = tile.extent;
        all.extend(Eigen::Vector2f(e.x - e.half_x, e.y - e.half_y));
        all.extend(Eigen::Vector2f(e.x + e.half_x, e.y + e.half_y));
    }
    whole_.extent = extent(all);
}

/// Bounds of all points that `count` samples can see between the heights `lowest` and `highest`, m.
Camera::Bounds Camera::bounds(std::size_t first, std::size_t count, double lowest, double highest) const {
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
    for (std::size_t k = first; k < first + count; ++k) box.extend(down_to(k, highest)).extend(last(k));
    Bounds out{box, box.center(), 0};
    for (std::size_t k = first; k < first + count; ++k)
        for (const Eigen::Vector3d& end : {down_to(k, highest), last(k)})
            out.radius = std::max(out.radius, (end - out.centre).norm());
    return out;
}

void Camera::make_bounds(double lowest) {
    const auto bound = [&](Tile& tile, std::size_t first, std::size_t count) {
        tile.all = bounds(first, count, lowest, std::numeric_limits<double>::infinity());
        tile.low = bounds(first, count, lowest, low_height);
    };
    for (Tile& tile : tiles_) bound(tile, tile.first, static_cast<std::size_t>(tile.pixels * samples_));
    bound(whole_, 0, ray_x_.size());
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
