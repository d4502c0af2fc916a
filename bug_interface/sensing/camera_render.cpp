// The rendering of one picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/solid_ray.h"

namespace forage::bug {

namespace {

constexpr double safely =
    1 - 1e-6;  ///< a factor for depths: nearer at some rays is nearer at all between them
constexpr double pixel_margin = 0.01;  ///< pixels; rays are in single precision

/// The first pixel that may show what begins at `at`, and one past the last that may show what ends there.
int first_pixel(double at) { return static_cast<int>(std::clamp(at - pixel_margin, 0.0, 1e6)); }
int end_pixel(double at, int pixels) {
    return static_cast<int>(std::ceil(std::clamp(at + pixel_margin, 0.0, static_cast<double>(pixels))));
}

Eigen::Array4f wide(const Colour& c) { return {c[0], c[1], c[2], 0}; }
Eigen::Array4f wide(const float* c) { return {c[0], c[1], c[2], 0}; }

/// Writes the mean colours of pixels whose samples are `apart` from each other.
template <class ColourOf>
void write_means(int pixels, int samples, std::size_t apart, float* rgb, ColourOf colour_of) {
    const float mean = 1.0f / static_cast<float>(samples);
    for (std::size_t p = 0; p < static_cast<std::size_t>(pixels); ++p, rgb += 3) {
        Eigen::Array4f sum = colour_of(p);
        for (int s = 1; s < samples; ++s) sum += colour_of(p + static_cast<std::size_t>(s) * apart);
        sum *= mean;
        std::memcpy(rgb, sum.data(), 3 * sizeof(float));
    }
}

void fill(const float* colour, std::size_t pixels, float* rgb) {
    const float red = colour[0], green = colour[1], blue = colour[2];
    for (std::size_t i = 0; i < pixels; ++i) rgb[3 * i] = red, rgb[3 * i + 1] = green, rgb[3 * i + 2] = blue;
}

/// The corners of a prism with four or eight sides as a camera sees it, m.
struct Prism {
    static constexpr std::size_t max_sides = 8, max_edges = 3 * max_sides;
    static constexpr std::size_t max_cuts = max_sides + 2;  ///< edges that a plane cuts
    std::size_t sides = 4;
    bool flat = false;  ///< whether there is only one polygon, `top`
    std::array<Eigen::Vector3d, max_sides> top, bottom;

    /// Contains `solid`, whose pose in the camera is `pose`; or what the camera sees of it.
    Prism(const Solid& solid, const Pose& pose) {
        const Eigen::Vector3d middle = pose.translation();
        Eigen::Matrix3d axes = pose.linear() * (solid.size / 2).asDiagonal();
        const double radius = solid.size.x() / 2, square = radius * radius / middle.squaredNorm();
        if (solid.kind == ShapeKind::sphere && square < 1) {  // a circle that fills the same part of the view
            flat = true;
            axes.col(0) = radius / std::sqrt(1 - square) * middle.unitOrthogonal();
            axes.col(1) = middle.normalized().cross(axes.col(0));
            axes.col(2).setZero();
        }
        // The corners of a square and of an octagon around a circle with the radius 1.
        constexpr double t = 0.41421356237309509;  // tan(pi / 8), rounded up
        constexpr double square_x[] = {1, -1, -1, 1}, square_y[] = {1, 1, -1, -1};
        constexpr double octagon_x[] = {1, t, -t, -1, -1, -t, t, 1},
                         octagon_y[] = {t, 1, 1, t, -t, -1, -1, -t};
        const bool round = flat || solid.kind == ShapeKind::cylinder;
        if (round) sides = max_sides;
        for (std::size_t i = 0; i < sides; ++i) {
            const Eigen::Vector3d at = middle + (round ? octagon_x : square_x)[i] * axes.col(0) +
                                       (round ? octagon_y : square_y)[i] * axes.col(1);
            top[i] = at + axes.col(2), bottom[i] = at - axes.col(2);
        }
    }
};

}  // namespace

struct Camera::View {
    /// The map from points of a floor in the frame of the robot, m, to texels: u = ux x + uy y + u0,
    /// v = vx x + vy y + v0.
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

    struct OnFloor;

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

struct Camera::Samples {
    std::array<double, max_block> depth, entry, face;  ///< as in Nearest; face 0 is the ground
    std::array<Eigen::Array4f, max_block>
        ground;  ///< where it has several colours; the fourth number is unused
};

void Camera::set_own(std::span<const VisualSolid> boxes) {
    const View view({}, scene_->floors());
    windows_.clear(), spans_.clear(), own_.clear();
    own_.reserve(blocks_.size());
    double first_face = 1;
    for (const VisualSolid& box : boxes) {
        if (add_window(view, box)) windows_.back().first_face = first_face;
        first_face += faces;
    }
    Samples samples;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
        own_blocks_[block] = -1;
        samples.depth.fill(far_), samples.face.fill(0);
        if (!meet_solids(block, samples)) continue;
        own_blocks_[block] = static_cast<int>(own_.size());
        OwnBlock& own = own_.emplace_back();
        for (std::size_t k = 0; k < block_samples_; ++k) {
            own.depth[k] = samples.face[k] > 0 ? static_cast<float>(samples.depth[k])
                                               : std::numeric_limits<float>::infinity();
            own.face[k] = static_cast<std::uint16_t>(samples.face[k]);
            if (own.face[k]) own.farthest = std::max(own.farthest, own.depth[k]);
        }
    }
}

/// Meets the samples of a block with the solids whose windows meet it. Returns false when there are none.
bool Camera::meet_solids(std::size_t block, Samples& samples) const {
    bool any = false;
    for (const Window& w : windows_)
        if (meets(w, block))
            any = true, intersect(w.solid, rays_of(block), w.first_face,
                                  {samples.depth.data(), samples.entry.data(), samples.face.data()});
    return any;
}

void Camera::render(const Pose2& robot, std::span<const VisualSolid* const> moving, std::span<float> rgb,
                    std::size_t own) {
    const View view(robot, scene_->floors());
    const Lighting& lighting = scene_->lighting();
    windows_.clear(), spans_.clear(), near_.clear(), colours_.resize(1);
    const auto add_colours = [&](const VisualSolid& visual) {
        for (int face = 0; face < 6; ++face) {
            const Eigen::Vector3d normal = visual.solid.pose.linear() * face_normal(face);
            colours_.push_back(wide(lighting.shade(visual.material, normal)));
        }
        colours_.emplace_back();
    };
    own_drawn_ = own > 0;
    std::fill(cover_.begin(), cover_.end(), bare);
    for (const VisualSolid* visual : moving.first(own)) add_colours(*visual);
    const auto add = [&](const VisualSolid& visual) {
        if (!sees(view, visual.solid) || !add_window(view, visual)) return;
        windows_.back().first_face = static_cast<double>(colours_.size());
        add_colours(visual);
        cover(windows_.back());
    };
    const Area area = view_area(robot);
    solids_.visit(area, [&](std::size_t i) { near_.push_back(i); });
    std::sort(near_.begin(),
              near_.end());  // the order of the scene decides between surfaces at the same depth
    for (const std::size_t i : near_) add(scene_->solids()[i]);
    for (const VisualSolid* visual : moving.subspan(own)) add(*visual);

    std::array<float, 3> colour;
    const float* ground = whole_.reaches_floor ? uniform_colour(view, whole_, colour.data()) : nullptr;
    for (int row = 0; row < height_; ++row)
        draw_row(view, row, ground,
                 &rgb[3 * static_cast<std::size_t>(row) * static_cast<std::size_t>(width_)]);
}

/// Renders one row. `ground` is the colour of all ground, null when it may have several.
void Camera::draw_row(const View& view, int row, const float* ground, float* rgb) {
    std::array<float, 3> of_row, of_block;
    const Extent& all = rows_[static_cast<std::size_t>(row)];
    if (!ground && all.reaches_floor) ground = uniform_colour(view, all, of_row.data());
    if (ground) fill(ground, static_cast<std::size_t>(width_), rgb);
    std::size_t block = static_cast<std::size_t>(row) * blocks_wide_;
    for (int column = 0; column < width_; column += block_width, ++block, rgb += 3 * block_width) {
        const int pixels = std::min(block_width, width_ - column), own = own_drawn_ ? own_blocks_[block] : -1;
        if (cover_[block] == bare && ground && own < 0) continue;
        const Extent& extent = blocks_[block];
        const bool one_face = cover_[block] != bare && cover_[block] != mixed;
        const float* behind = one_face               ? colours_[cover_[block]].data()
                              : ground               ? ground
                              : extent.reaches_floor ? uniform_colour(view, extent, of_block.data())
                                                     : nullptr;
        const bool plain = cover_[block] != mixed && behind;  // one colour, behind own solids
        if (plain && own < 0)
            fill(behind, static_cast<std::size_t>(pixels), rgb);
        else if (plain && (cover_[block] != bare ||
                           own_[static_cast<std::size_t>(own)].farthest < nearest_floor_[block]))
            draw_own(own_[static_cast<std::size_t>(own)], behind, pixels, rgb);
        else if (cover_[block] == bare && own < 0 && extent.reaches_floor && shows_floor(view, extent))
            draw_textured(view, block, pixels, rgb);
        else
            draw_block(view, block, pixels, one_face ? nullptr : behind, rgb);
    }
}

/// Renders a block with own solids before something of one colour.
void Camera::draw_own(const OwnBlock& own, const float* behind, int pixels, float* rgb) {
    colours_.front() = wide(behind);
    write_means(pixels, samples_, block_width, rgb,
                [&](std::size_t k) -> const Eigen::Array4f& { return colours_[own.face[k]]; });
}

/// Extends the columns of each row, from `first_row` on, by those of a line between two points, in pixels to
/// the right and down.
void Camera::extend(Eigen::Vector2d a, Eigen::Vector2d b, int first_row) {
    if (a.y() > b.y()) std::swap(a, b);
    const double slope = b.y() - a.y() > 1e-9 ? (b.x() - a.x()) / (b.y() - a.y()) : 0;
    const int last_row = first_row + static_cast<int>(reach_.size()) - 1,
              begin = std::max(first_row,
                               static_cast<int>(std::floor(std::clamp(a.y() - pixel_margin, -1.0, 1e6)))),
              end = std::min(last_row, static_cast<int>(std::clamp(b.y() + pixel_margin, -1.0, 1e6)));
    for (int row = begin; row <= end; ++row) {
        const double above = row - pixel_margin, below = row + 1 + pixel_margin;
        const double x = a.y() > above ? a.x() : a.x() + slope * (above - a.y()),
                     y = b.y() < below ? b.x() : a.x() + slope * (below - a.y());
        std::array<double, 2>& reach = reach_[static_cast<std::size_t>(row - first_row)];
        reach[0] = std::min({reach[0], x, y}), reach[1] = std::max({reach[1], x, y});
    }
}

/// The only face that some blocks of a row show of a solid, as in Window::first_face; 0 when there may be
/// several, or ground. A face is convex, so it fills what is between its rays.
std::size_t Camera::full_face(const Window& w, std::size_t first_block, std::size_t last_block,
                              double& least) const {
    const auto per_axis = static_cast<std::size_t>(std::lround(std::sqrt(samples_)));
    const std::size_t top = first_block * block_samples_,
                      last = last_block * block_samples_ + block_width - 1,
                      down = block_width * per_axis * (per_axis - 1), right = block_width * (per_axis - 1);
    const std::array<std::size_t, 4> ends = {top, top + down, last + right, last + down + right};
    std::array<float, 4> x, y, z;
    std::array<double, 4> depth, entry, face;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const std::size_t k = ends[i];
        x[i] = ray_x_[k], y[i] = ray_y_[k], z[i] = ray_z_[k];
        depth[i] = far_ * safely, face[i] = 0;
        for (const FloorPoints& floor : floor_points_) depth[i] = std::min(depth[i], floor.depth[k] * safely);
    }
    intersect(w.solid, {x.data(), y.data(), z.data(), x.size()}, w.first_face,
              {depth.data(), entry.data(), face.data()});
    least = depth[0];
    for (std::size_t i = 1; i < 4; ++i) {
        if (face[i] != face[0]) return 0;
        least = std::min(least, depth[i]);
    }
    return face[0] == w.first_face + Nearest::curved ? 0 : static_cast<std::size_t>(face[0]);
}

/// Notes in which blocks a solid is seen.
void Camera::cover(const Window& w) {
    const auto note = [&](std::size_t block, std::size_t face, double depth) {
        const int own = own_drawn_ ? own_blocks_[block] : -1;
        const bool before = own >= 0 && !(own_[static_cast<std::size_t>(own)].farthest < safely * depth);
        cover_[block] = cover_[block] == bare && face > 0 && face < mixed && !before
                            ? static_cast<std::uint16_t>(face)
                            : mixed;
    };
    for (int row = w.first_row; row < w.end_row; ++row) {
        const Span s = span(w, row);
        if (s.first >= s.end) continue;
        const std::size_t begin = static_cast<std::size_t>(row) * blocks_wide_,
                          first = begin + static_cast<std::size_t>(s.first / block_width),
                          last = begin + static_cast<std::size_t>((s.end - 1) / block_width);
        const bool from_edge = s.first % block_width == 0,
                   to_edge = s.end % block_width == 0 || s.end == width_;
        double depth = 0;
        const std::size_t everywhere = from_edge && to_edge ? full_face(w, first, last, depth) : 0;
        for (std::size_t block = first; block <= last; ++block) {
            std::size_t face = everywhere;
            if (!face && cover_[block] == bare && (block > first || from_edge) && (block < last || to_edge))
                face = full_face(w, block, block, depth);
            note(block, face, depth);
        }
    }
}

/// Adds the window of a solid: the pixels inside the outline of what is before the camera of a prism around
/// the solid. Returns false when there are none.
bool Camera::add_window(const View& view, const VisualSolid& visual) {
    constexpr double near = 1e-6;  // m along the optical axis
    const Solid& solid = visual.solid;
    const Pose to_camera = (view.pose * mount_).inverse(Eigen::Isometry) * solid.pose;
    const Prism prism(solid, to_camera);
    // The edges of the part before the camera, in pixels to the right and down. All lines between the cuts
    // through a plane are inside the outline.
    std::array<std::array<Eigen::Vector2d, 2>, Prism::max_edges + Prism::max_cuts*(Prism::max_cuts - 1) / 2>
        lines;
    std::array<Eigen::Vector2d, Prism::max_cuts> cuts;
    std::size_t count = 0, cut = 0;
    Eigen::AlignedBox2d box;
    const auto pixel = [&](const Eigen::Vector3d& at) -> Eigen::Vector2d {
        const Eigen::Vector2d p((1 - at.y() / at.x() / tan_x_) * width_ / 2,
                                (1 - at.z() / at.x() / tan_y_) * height_ / 2);
        box.extend(p);
        return p;
    };
    const auto add_edge = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
        const Eigen::Vector3d *a = &from, *b = &to;
        if (a->x() > b->x()) std::swap(a, b);
        if (b->x() < near) return;
        if (a->x() >= near) {
            lines[count++] = {pixel(*a), pixel(*b)};
            return;
        }
        Eigen::Vector3d at = *a + (near - a->x()) / (b->x() - a->x()) * (*b - *a);
        at.x() = near;
        lines[count++] = {pixel(at), pixel(*b)};
        if (cut < cuts.size()) cuts[cut++] = lines[count - 1][0];
    };
    for (std::size_t i = 0; i < prism.sides; ++i) {
        const std::size_t next = (i + 1) % prism.sides;
        add_edge(prism.top[i], prism.top[next]);
        if (prism.flat) continue;
        add_edge(prism.bottom[i], prism.bottom[next]);
        add_edge(prism.top[i], prism.bottom[i]);
    }
    for (std::size_t i = 0; i < cut; ++i)
        for (std::size_t k = i + 1; k < cut; ++k) lines[count++] = {cuts[i], cuts[k]};
    if (count == 0) return false;
    const int first_row = first_pixel(box.min().y()), end_row = end_pixel(box.max().y(), height_);
    if (first_pixel(box.min().x()) >= end_pixel(box.max().x(), width_) || first_row >= end_row) return false;
    reach_.assign(static_cast<std::size_t>(end_row - first_row), {1e9, -1e9});
    for (std::size_t i = 0; i < count; ++i) extend(lines[i][0], lines[i][1], first_row);
    const std::size_t first_span = spans_.size();
    for (const std::array<double, 2>& reach : reach_)
        spans_.push_back({first_pixel(reach[0]), end_pixel(reach[1], width_)});
    const Eigen::Matrix3d turn = solid.pose.linear().transpose() * view.pose.linear();
    const Eigen::Vector3d eye =
        solid.pose.linear().transpose() * (view.pose * mount_.translation() - solid.pose.translation());
    windows_.push_back({&visual, {solid.kind, solid.size / 2, eye, turn}, 0, first_row, end_row, first_span});
    return true;
}

/// Whether a solid may be visible: its box meets the sphere of all that the camera sees, and the box of that
/// meets its sphere. Both tests are needed, as spheres are poor bounds of long walls.
bool Camera::sees(const View& view, const Solid& solid) const {
    const bool low = solid.pose.translation().z() + half_height(solid) <= low_height;
    const Bounds& bounds = low ? low_ : all_;
    const Eigen::Vector3d centre =
        solid.pose.linear().transpose() * (view.pose * bounds.centre - solid.pose.translation());
    const Eigen::Vector3d outside = (centre.cwiseAbs() - solid.size / 2).cwiseMax(0);
    if (outside.squaredNorm() > bounds.radius * bounds.radius) return false;
    const Eigen::Vector3d middle =
        view.pose.linear().transpose() * (solid.pose.translation() - view.pose.translation());
    return bounds.box.squaredExteriorDistance(middle) <= radius_squared(solid);
}

/// A rectangle on the texture of the only floor that contains all samples of an extent, texels.
struct Camera::View::OnFloor {
    float u_first, u_last, v_first, v_last;

    OnFloor(const View& view, const Extent& e) {
        constexpr float margin = 0.01f;  // texels; well above the errors of single precision
        const ToTexels& to = *view.to_texels;
        const float u = to.u(e.x, e.y), v = to.v(e.x, e.y),
                    half_u = std::abs(to.ux) * e.half_x + std::abs(to.uy) * e.half_y + margin,
                    half_v = std::abs(to.vx) * e.half_x + std::abs(to.vy) * e.half_y + margin;
        u_first = u - half_u, u_last = u + half_u, v_first = v - half_v, v_last = v + half_v;
    }
    bool inside(const FloorTexture& texture) const {
        return u_first >= 0 && u_last <= static_cast<float>(texture.width()) && v_first >= 0 &&
               v_last <= static_cast<float>(texture.height());
    }
};

/// Whether some rays that reach the floor show only the interior of the only one.
bool Camera::shows_floor(const View& view, const Extent& extent) {
    return view.floor && View::OnFloor(view, extent).inside(view.floor->texture);
}

/// Writes the colour of the floor in an extent to `colour` and returns it. Null when there are several
/// colours.
const float* Camera::uniform_colour(const View& view, const Extent& extent, float* colour) const {
    if (!view.floor) return nullptr;
    const View::OnFloor at(view, extent);
    const FloorTexture& texture = view.floor->texture;
    if (!at.inside(texture) || !texture.uniform(at.u_first, at.u_last, at.v_first, at.v_last)) return nullptr;
    const std::uint32_t texel = texture.texel(texture.index(at.u_first, at.v_first));
    colour[0] = texture.red(texel), colour[1] = texture.green(texel), colour[2] = texture.blue(texel);
    return colour;
}

/// Renders pixels of a block that show only the interior of the only floor.
void Camera::draw_textured(const View& view, std::size_t block, int pixels, float* rgb) const {
    const FloorTexture& texture = view.floor->texture;
    const View::ToTexels& to = *view.to_texels;
    const float mean = 1.0f / static_cast<float>(samples_);
    for (int p = 0; p < pixels; ++p, rgb += 3) {
        std::array<float, max_samples> u, v;
        std::array<std::uint32_t, max_samples> texels{};
        bool uniform = true;
        for (int s = 0; s < samples_; ++s) {
            const std::size_t k = block * block_samples_ + static_cast<std::size_t>(s * block_width + p);
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

/// Finds the ground of a block: the floors, and the background where there is none. `ground` as in
/// draw_row().
void Camera::draw_floors(const View& view, std::size_t block, const float* ground, Samples& samples) const {
    const std::size_t first = block * block_samples_;
    if (ground) {
        std::copy_n(&floor_points_.front().depth[first], block_samples_, samples.depth.begin());
        return;
    }
    std::fill_n(samples.ground.begin(), block_samples_, Eigen::Array4f::Constant(Scene::background));
    std::fill_n(samples.depth.begin(), block_samples_, static_cast<float>(far_));
    for (std::size_t f = 0; f < floor_points_.size(); ++f) {  // a higher floor hides a lower one
        const FloorSurface& floor = scene_->floors()[f];
        const View::ToTexels to(floor, view.robot.x, view.robot.y, view.robot.yaw);
        const auto width = static_cast<float>(floor.texture.width()),
                   height = static_cast<float>(floor.texture.height());
        for (std::size_t k = 0; k < block_samples_; ++k) {
            const float x = floor_points_[f].x[first + k], y = floor_points_[f].y[first + k];
            const float u = to.u(x, y), v = to.v(x, y);
            if (!(u >= 0 && u <= width && v >= 0 && v <= height))
                continue;  // also when the ray does not meet the floor and (u, v) is infinite
            samples.depth[k] = floor_points_[f].depth[first + k];
            samples.ground[k].setZero();
            floor.texture.add(u, v, samples.ground[k].data());
        }
    }
}

/// Renders a block with floors and solids.
void Camera::draw_block(const View& view, std::size_t block, int pixels, const float* ground, float* rgb) {
    Samples samples;
    draw_floors(view, block, ground, samples);
    std::fill_n(samples.face.begin(), block_samples_, 0.0);
    if (own_drawn_ && own_blocks_[block] >= 0) {
        const OwnBlock& own = own_[static_cast<std::size_t>(own_blocks_[block])];
        for (std::size_t k = 0; k < block_samples_; ++k) {
            const bool nearer = own.depth[k] < samples.depth[k];
            samples.depth[k] = nearer ? static_cast<double>(own.depth[k]) : samples.depth[k];
            samples.face[k] = nearer ? static_cast<double>(own.face[k]) : samples.face[k];
        }
    }
    meet_solids(block, samples);

    std::array<std::int32_t, max_block> faces_of;
    std::copy_n(samples.face.begin(), block_samples_, faces_of.begin());
    if (ground) colours_.front() = wide(ground);
    std::array<Eigen::Array4f, max_block> colours;
    for (std::size_t k = 0; k < block_samples_; ++k)
        colours[k] = colours_[static_cast<std::size_t>(faces_of[k])];
    for (std::size_t k = 0; k < block_samples_ && !ground; ++k)
        if (faces_of[k] == 0) colours[k] = samples.ground[k];
    for (const Window& w : windows_)
        if (meets(w, block) && w.visual->solid.kind != ShapeKind::box)
            shade_curved(w, block, samples, faces_of.data(), colours.data());
    write_means(pixels, samples_, block_width, rgb,
                [&](std::size_t k) -> const Eigen::Array4f& { return colours[k]; });
}

/// Replaces the colours of the samples of a block that show the curved face of a solid.
void Camera::shade_curved(const Window& w, std::size_t block, const Samples& samples,
                          const std::int32_t* faces_of, Eigen::Array4f* colours) const {
    const auto curved = static_cast<std::int32_t>(w.first_face + Nearest::curved);
    bool any = false;
    for (std::size_t k = 0; k < block_samples_; ++k) any |= faces_of[k] == curved;
    if (!any) return;
    const Lighting& lighting = scene_->lighting();
    const Material& material = w.visual->material;
    std::array<double, max_block> lit;
    if (lighting.sun)
        light_curved(w.solid, w.visual->solid.pose.linear(), *lighting.sun, rays_of(block),
                     samples.entry.data(), lit.data());
    else
        lit.fill(0);
    const Eigen::Array4f ambient = wide(material.ambient * lighting.ambient),
                         diffuse = wide(material.diffuse);
    for (std::size_t k = 0; k < block_samples_; ++k)
        if (faces_of[k] == curved)
            colours[k] = (ambient + diffuse * static_cast<float>(lit[k])).min(1.0f).max(0.0f);
}

}  // namespace forage::bug
