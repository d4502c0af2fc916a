// The rendering of one picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/solid_ray.h"

namespace forage::bug {
namespace {

constexpr std::size_t tile_samples = 32 * 16;  ///< the largest number in a tile

/// The samples of one tile while it is rendered.
struct Samples {
    std::array<Eigen::Array4f, tile_samples> rgb;  ///< the fourth number is unused
    std::array<float, tile_samples> depth;  ///< depth of the nearest surface so far, along the optical axis
    std::array<double, tile_samples> entry, face;  ///< entries into one solid, as in Entries
};

}  // namespace

struct Camera::View {
    /// The map from points of a floor in the frame of the robot, m, to texels: u = ux x + uy y + u0, and
    /// likewise for v.
    struct ToTexels {
        float ux, uy, u0, vx, vy, v0;

        ToTexels(const FloorSurface& floor, double x, double y, double yaw) {
            const double across = floor.texture.width() / floor.size_x,
                         down = floor.texture.height() / floor.size_y;
            const double cf = std::cos(floor.pose.yaw), sf = std::sin(floor.pose.yaw);
            const double dx = x - floor.pose.x, dy = y - floor.pose.y;
            const double c = std::cos(yaw - floor.pose.yaw), s = std::sin(yaw - floor.pose.yaw);
            ux = static_cast<float>(across * c), uy = static_cast<float>(-across * s);
            vx = static_cast<float>(-down * s), vy = static_cast<float>(-down * c);
            u0 = static_cast<float>(across * (cf * dx + sf * dy + floor.size_x / 2));
            v0 = static_cast<float>(down * (floor.size_y / 2 - (cf * dy - sf * dx)));
        }
        float u(float x, float y) const { return ux * x + uy * y + u0; }
        float v(float x, float y) const { return vx * x + vy * y + v0; }
    };

    Pose2 robot;
    Pose pose;                            ///< pose of the robot in the world, in three dimensions
    const FloorSurface* floor = nullptr;  ///< the only floor, if there is one and it is low
    std::optional<ToTexels> to_texels;    ///< transform to the texels of that floor

    View(const Pose2& r, std::span<const FloorSurface> floors) : robot(r), pose(Pose::Identity()) {
        if (floors.size() == 1 && floors.front().z <= low_height) {
            floor = &floors.front();
            to_texels.emplace(*floor, r.x, r.y, r.yaw);
        }
        pose.linear() = Eigen::AngleAxisd(r.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        pose.translation() = Eigen::Vector3d(r.x, r.y, 0);
    }
};

void Camera::render(const Pose2& robot, std::span<const VisualSolid* const> moving, std::span<float> rgb) {
    const View view(robot, scene_->floors());
    windows_.clear();
    const auto add_window = [&](const VisualSolid& visual) {
        if (!sees(view, whole_, visual)) return;
        const Window w = window(view, visual);
        if (w.first_column < w.end_column && w.first_row < w.end_row) windows_.push_back(w);
    };
    for (const VisualSolid& visual : scene_->solids()) add_window(visual);
    for (const VisualSolid* visual : moving) add_window(*visual);
    std::array<float, 3> colour;
    if (windows_.empty() && whole_.reaches_floor && uniform_colour(view, whole_.extent, colour.data())) {
        for (std::size_t i = 0; i < rgb.size(); i += 3) std::copy_n(colour.begin(), 3, &rgb[i]);
        return;
    }
    for (const Tile& tile : tiles_) {
        float* out = &rgb[3 * (static_cast<std::size_t>(tile.row) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(tile.column))];
        const bool bare = std::none_of(windows_.begin(), windows_.end(),
                                       [&](const Window& w) { return sees(view, tile, w); });
        if (!bare || !draw_bare_floor(view, tile, out)) draw_all(view, tile, out);
    }
}

/// The pixels between the projected corners of a solid's bounding box; all pixels when a corner is behind the
/// camera.
Camera::Window Camera::window(const View& view, const VisualSolid& visual) const {
    const Solid& solid = visual.solid;
    const Pose to_camera = (view.pose * mount_).inverse(Eigen::Isometry) * solid.pose;
    const Eigen::Vector3d middle = to_camera.translation();
    const Eigen::Matrix3d sides = to_camera.linear() * (solid.size / 2).asDiagonal();
    Eigen::AlignedBox2d slopes;  // to the left and up, in m per m along the optical axis
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d at = middle + (corner & 1 ? 1 : -1) * sides.col(0) +
                                   (corner & 2 ? 1 : -1) * sides.col(1) +
                                   (corner & 4 ? 1 : -1) * sides.col(2);
        if (at.x() < 1e-3) return {&visual, 0, width_, 0, height_};
        slopes.extend(Eigen::Vector2d(at.y() / at.x(), at.z() / at.x()));
    }
    constexpr double margin = 0.01;  // pixels; rays are in single precision
    const auto pixel = [](double slope, double tan, int pixels) {
        return std::clamp((1 - slope / tan) * pixels / 2, -2.0, pixels + 2.0);
    };
    const auto first = [&](double p) { return std::max(0, static_cast<int>(std::floor(p - margin))); };
    const auto end = [&](double p, int pixels) {
        return std::min(pixels, static_cast<int>(std::ceil(p + margin)));
    };
    return {&visual, first(pixel(slopes.max().x(), tan_x_, width_)),
            end(pixel(slopes.min().x(), tan_x_, width_), width_),
            first(pixel(slopes.max().y(), tan_y_, height_)),
            end(pixel(slopes.min().y(), tan_y_, height_), height_)};
}

bool Camera::sees(const View& view, const Tile& tile, const Window& w) {
    return tile.row >= w.first_row && tile.row < w.end_row && tile.column < w.end_column &&
           tile.column + tile.pixels > w.first_column && sees(view, tile, *w.visual);
}

/// Whether a solid may be visible in a tile: its box meets the tile's sphere, and the tile's box meets its
/// sphere. Both tests are needed, as spheres are poor bounds of long walls and of rows of pixels.
bool Camera::sees(const View& view, const Tile& tile, const VisualSolid& visual) {
    const Solid& solid = visual.solid;
    const bool low = solid.pose.translation().z() + half_height(solid) <= low_height;
    const Bounds& bounds = low ? tile.low : tile.all;
    const Eigen::Vector3d centre =
        solid.pose.linear().transpose() * (view.pose * bounds.centre - solid.pose.translation());
    const Eigen::Vector3d outside = (centre.cwiseAbs() - solid.size / 2).cwiseMax(0);
    if (outside.squaredNorm() > bounds.radius * bounds.radius) return false;
    const Eigen::Vector3d middle =
        view.pose.linear().transpose() * (solid.pose.translation() - view.pose.translation());
    return bounds.box.squaredExteriorDistance(middle) <= radius_squared(solid);
}

/// Writes the colour of the floor in an extent to `colour` and returns it. Null when there are several
/// colours.
const float* Camera::uniform_colour(const View& view, const Extent& e, float* colour) const {
    if (!view.floor) return nullptr;
    constexpr float margin = 0.01f;  // texels; well above the errors of single precision
    const View::ToTexels& to = *view.to_texels;
    const float u = to.u(e.x, e.y), half_u = std::abs(to.ux) * e.half_x + std::abs(to.uy) * e.half_y + margin;
    const float v = to.v(e.x, e.y), half_v = std::abs(to.vx) * e.half_x + std::abs(to.vy) * e.half_y + margin;
    const float u_first = u - half_u, u_last = u + half_u, v_first = v - half_v, v_last = v + half_v;
    const FloorTexture& texture = view.floor->texture;
    if (!(u_first >= 0 && u_last <= static_cast<float>(texture.width()) && v_first >= 0 &&
          v_last <= static_cast<float>(texture.height()) &&
          texture.uniform(u_first, u_last, v_first, v_last)))
        return nullptr;
    const std::uint32_t texel = texture.texel(texture.index(u_first, v_first));
    colour[0] = texture.red(texel), colour[1] = texture.green(texel), colour[2] = texture.blue(texel);
    return colour;
}

/// Renders a tile that shows only the interior of the only floor, which is the common case. Returns false
/// when the tile may show something else.
bool Camera::draw_bare_floor(const View& view, const Tile& tile, float* rgb) const {
    if (!view.floor || !tile.reaches_floor) return false;
    std::array<float, 3> colour;
    const auto fill = [&](int pixels, float* to) {
        for (int p = 0; p < pixels; ++p, to += 3) std::copy_n(colour.begin(), 3, to);
    };
    if (uniform_colour(view, tile.extent, colour.data())) return fill(tile.pixels, rgb), true;
    const FloorSurface& floor = *view.floor;
    const Eigen::Vector3d centre = view.pose * tile.low.centre;
    const double cf = std::cos(floor.pose.yaw), sf = std::sin(floor.pose.yaw);
    const double x = centre.x() - floor.pose.x, y = centre.y() - floor.pose.y;
    if (!(std::abs(cf * x + sf * y) + tile.low.radius < floor.size_x / 2 &&
          std::abs(cf * y - sf * x) + tile.low.radius < floor.size_y / 2))
        return false;
    for (int first = 0; first < tile.pixels; first += segment_width) {
        const int pixels = std::min(segment_width, tile.pixels - first);
        if (uniform_colour(view, tile.segments[static_cast<std::size_t>(first / segment_width)],
                           colour.data()))
            fill(pixels, rgb + 3 * first);
        else
            draw_textured(view, tile, first, pixels, rgb + 3 * first);
    }
    return true;
}

/// Renders pixels of a tile that show only the interior of the only floor.
void Camera::draw_textured(const View& view, const Tile& tile, int first_pixel, int pixels,
                           float* rgb) const {
    const FloorTexture& texture = view.floor->texture;
    const View::ToTexels& to = *view.to_texels;
    const float mean = 1.0f / static_cast<float>(samples_);
    for (int p = first_pixel; p < first_pixel + pixels; ++p, rgb += 3) {
        std::array<float, max_samples> u, v;
        std::array<std::uint32_t, max_samples> texels{};
        bool uniform = true;
        for (int s = 0; s < samples_; ++s) {
            const std::size_t k = tile.first + static_cast<std::size_t>(s * tile.pixels + p);
            const auto i = static_cast<std::size_t>(s);
            const float x = floor_points_.front().x[k], y = floor_points_.front().y[k];
            u[i] = to.u(x, y), v[i] = to.v(x, y);
            texels[i] = texture.texel(texture.index(u[i], v[i]));
            uniform &= FloorTexture::flat(texels[i]) && texels[i] == texels[0];
        }
        if (uniform) {
            rgb[0] = texture.red(texels[0]), rgb[1] = texture.green(texels[0]),
            rgb[2] = texture.blue(texels[0]);
            continue;
        }
        rgb[0] = rgb[1] = rgb[2] = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(samples_); ++i) texture.add(u[i], v[i], rgb);
        for (int channel = 0; channel < 3; ++channel) rgb[channel] *= mean;
    }
}

/// Renders a tile with floors and solids.
void Camera::draw_all(const View& view, const Tile& tile, float* rgb) const {
    Samples samples;
    const auto pixels = static_cast<std::size_t>(tile.pixels);
    const std::size_t count = pixels * static_cast<std::size_t>(samples_);
    std::fill_n(samples.rgb.begin(), count, Eigen::Array4f::Constant(Scene::background));
    std::fill_n(samples.depth.begin(), count, static_cast<float>(far_));

    std::array<float, 3> floor_colour;
    const bool uniform = tile.reaches_floor && uniform_colour(view, tile.extent, floor_colour.data());
    if (uniform) {
        std::copy_n(&floor_points_.front().depth[tile.first], count, samples.depth.begin());
        std::fill_n(samples.rgb.begin(), count,
                    Eigen::Array4f(floor_colour[0], floor_colour[1], floor_colour[2], 0));
    }
    for (std::size_t f = 0; f < floor_points_.size() && !uniform; ++f) {  // a higher floor hides a lower one
        const FloorSurface& floor = scene_->floors()[f];
        const View::ToTexels to(floor, view.robot.x, view.robot.y, view.robot.yaw);
        const auto width = static_cast<float>(floor.texture.width()),
                   height = static_cast<float>(floor.texture.height());
        for (std::size_t k = 0; k < count; ++k) {
            const float x = floor_points_[f].x[tile.first + k], y = floor_points_[f].y[tile.first + k];
            const float u = to.u(x, y), v = to.v(x, y);
            if (!(u >= 0 && u <= width && v >= 0 && v <= height))
                continue;  // also when the ray does not meet the floor and (u, v) is infinite
            samples.depth[k] = floor_points_[f].depth[tile.first + k];
            samples.rgb[k].setZero();
            floor.texture.add(u, v, samples.rgb[k].data());
        }
    }

    const Lighting& lighting = scene_->lighting();
    for (const Window& w : windows_) {
        if (!sees(view, tile, w)) continue;
        const VisualSolid& visual = *w.visual;
        const Solid& solid = visual.solid;
        const Eigen::Matrix3d turn = solid.pose.linear().transpose() * view.pose.linear();
        const Eigen::Vector3d half = solid.size / 2;
        const Eigen::Vector3d eye =
            solid.pose.linear().transpose() * (view.pose * mount_.translation() - solid.pose.translation());
        std::array<Colour, 6> faces;
        for (int face = 0; face < 6; ++face)
            faces[static_cast<std::size_t>(face)] =
                lighting.shade(visual.material, solid.pose.linear() * face_normal(face));
        const auto from = static_cast<std::size_t>(std::max(0, w.first_column - tile.column)),
                   to = static_cast<std::size_t>(std::min(tile.pixels, w.end_column - tile.column));
        const bool by_sample = 2 * (to - from) < pixels;  // else the rays that miss cost less than more calls
        const std::size_t runs = by_sample ? static_cast<std::size_t>(samples_) : 1,
                          first = by_sample ? from : 0, last = by_sample ? to : count;
        const auto draw = [&](std::size_t begin, std::size_t end) {
            intersect(solid.kind, half, eye, turn,
                      {&ray_x_[tile.first + begin], &ray_y_[tile.first + begin], &ray_z_[tile.first + begin],
                       end - begin},
                      {&samples.entry[begin], &samples.face[begin]});
            for (std::size_t k = begin; k < end; ++k) {
                if (!(samples.entry[k] < samples.depth[k])) continue;
                const std::size_t i = tile.first + k;
                samples.depth[k] = static_cast<float>(samples.entry[k]);
                samples.rgb[k].head<3>() =
                    samples.face[k] == Entries::curved
                        ? lighting.shade(
                              visual.material,
                              solid.pose.linear() *
                                  curved_normal(solid.kind, eye,
                                                turn * Eigen::Vector3d(ray_x_[i], ray_y_[i], ray_z_[i]),
                                                samples.entry[k]))
                        : faces[static_cast<std::size_t>(samples.face[k])];
            }
        };
        for (std::size_t run = 0; run < runs; ++run) draw(run * pixels + first, run * pixels + last);
    }

    const float mean = 1.0f / static_cast<float>(samples_);
    for (std::size_t p = 0; p < pixels; ++p, rgb += 3) {
        Eigen::Array4f sum = samples.rgb[p];
        for (std::size_t k = p + pixels; k < count; k += pixels) sum += samples.rgb[k];
        Eigen::Map<Eigen::Array3f>{rgb} = sum.head<3>() * mean;
    }
}

}  // namespace forage::bug
