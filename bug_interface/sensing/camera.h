// The camera: small colour pictures of a scene, rendered by ray casting.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bug_interface/sensing/grid.h"
#include "bug_interface/sensing/scene.h"
#include "bug_interface/sensing/solid_ray.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// A pinhole camera on a robot that moves in the plane.
///
/// The rays are constant in the frame of the robot, and so are the points where they meet the floor. A
/// picture of bare floor only needs the transform of these points into the texture. Solids are tested ray by
/// ray in the blocks of pixels that their windows meet.
class Camera {
  public:
    /// `link_pose` is the pose of the camera's link in the robot. Each pixel is the mean of
    /// samples_per_axis^2 rays. Throws std::invalid_argument when `samples_per_axis` is not 1 to 4.
    Camera(const CameraSensor& sensor, const Pose& link_pose, std::shared_ptr<const Scene> scene,
           int samples_per_axis = 2);

    /// Makes room for what render() works with, which a copy of a camera lacks.
    void reserve();

    int width() const { return width_; }    ///< pixels
    int height() const { return height_; }  ///< pixels

    /// Renders the scene and the solids `moving` from a robot at the pose `robot`, without noise. `rgb` has
    /// height x width x 3 values in 0..1; row 0 is the top (far), column 0 the left. The first `own` solids
    /// are those of set_own(), placed in the world. Allocates memory only when there are more solids than
    /// ever before.
    void render(const Pose2& robot, std::span<const VisualSolid* const> moving, std::span<float> rgb,
                std::size_t own = 0);

    /// Looks up what the camera sees of boxes that are fixed to its robot, so that render() does not have to.
    /// `boxes` are in the frame of the robot. Allocates memory only when more can be seen than ever before.
    void set_own(std::span<const VisualSolid> boxes);

    /// What the camera may see from a robot at the pose `robot`: solids that do not meet this area are not in
    /// the picture.
    Area view_area(const Pose2& robot) const;

    /// Adds noise and rounds to 8 bits. A normally distributed random number is drawn for each pixel and
    /// added to its three channels. `sample` is the number of the picture; the same sample has the same
    /// noise.
    void quantise(std::span<const float> rgb, std::span<std::uint8_t> out, const RandomStream& random,
                  std::uint64_t sample) const;

    /// The point where the ray through the centre of pixel (column, row) meets the plane z = 0, in the frame
    /// of the robot, m. Empty above the horizon.
    std::optional<Eigen::Vector2d> floor_point(int column, int row) const;

  private:
    static constexpr int block_width = 8;       ///< pixels of one row that are drawn together
    static constexpr int max_samples = 16;      ///< largest number of samples per pixel
    static constexpr double low_height = 0.02;  ///< m; solids below it (paint) have tighter bounds
    static constexpr std::size_t max_block = static_cast<std::size_t>(block_width) * max_samples;
    static constexpr std::size_t faces = 7;  ///< of a solid: six flat ones and the curved one

    /// A box and a sphere that both contain all points that some rays can see, in the frame of the robot.
    struct Bounds {
        Eigen::AlignedBox3d box;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double radius = 0;
    };
    /// Where the samples of some pixels meet the floor.
    struct Extent {
        /// The centre and half the sides of their bounding rectangle, when there is only one floor; in the
        /// frame of the robot, m.
        float x = 0, y = 0, half_x = 0, half_y = 0;
        bool reaches_floor = true;  ///< whether all rays would meet all floors if the floors were infinite
    };
    /// The points where all samples meet one floor, in the frame of the robot, m; infinity where they do not.
    struct FloorPoints {
        std::vector<float> x, y;
        std::vector<float> depth;  ///< along the optical axis, m
    };
    struct View;  ///< values that are constant in one picture
    /// A solid in one picture, and the rows in which it may be visible; the end is one past the last.
    struct Window {
        const VisualSolid* visual = nullptr;
        SolidInView solid;
        double first_face = 0;  ///< the number of its first face in `colours_`
        int first_row = 0, end_row = 0;
        std::size_t first_span = 0;  ///< the number of its first row in `spans_`
    };
    /// Columns of one row; the end is one past the last.
    struct Span {
        int first, end;
    };
    /// The samples of one block while it is drawn.
    struct Samples;
    /// What the camera sees of set_own() in the samples of one block.
    struct OwnBlock {
        std::array<float, max_block> depth;         ///< infinity where it sees nothing of it
        std::array<std::uint16_t, max_block> face;  ///< as in Window::first_face
        float farthest = 0;                         ///< the largest depth of what it sees of it
    };

    Eigen::Vector3d ray(double column, double row) const;
    void make_samples(int samples_per_axis);
    void make_floor_points();
    Bounds bounds(double lowest, double highest) const;
    void make_extents();
    bool sees(const View& view, const Solid& solid) const;
    void extend(Eigen::Vector2d a, Eigen::Vector2d b, int first_row);
    bool add_window(const View& view, const VisualSolid& visual);
    void cover(const Window& window);
    bool meets(const Window& w, std::size_t block) const {
        const int row = static_cast<int>(block / blocks_wide_),
                  column = static_cast<int>(block % blocks_wide_) * block_width;
        return row >= w.first_row && row < w.end_row && column < span(w, row).end &&
               column + block_width > span(w, row).first;
    }
    bool meet_solids(std::size_t block, Samples& samples) const;
    std::size_t full_face(const Window& window, std::size_t first_block, std::size_t last_block,
                          double& depth) const;
    void draw_own(const OwnBlock& own, const float* behind, int pixels, float* rgb);
    Span span(const Window& window, int row) const {
        return spans_[window.first_span + static_cast<std::size_t>(row - window.first_row)];
    }
    const float* uniform_colour(const View& view, const Extent& extent, float* colour) const;
    static bool shows_floor(const View& view, const Extent& extent);
    void draw_row(const View& view, int row, const float* ground, float* rgb);
    void draw_textured(const View& view, std::size_t block, int pixels, float* rgb) const;
    void draw_block(const View& view, std::size_t block, int pixels, const float* ground, float* rgb);
    void shade_curved(const Window& window, std::size_t block, const Samples& samples,
                      const std::int32_t* faces_of, Eigen::Array4f* colours) const;
    void draw_floors(const View& view, std::size_t block, const float* ground, Samples& samples) const;
    Rays rays_of(std::size_t block) const {
        const std::size_t first = block * block_samples_;
        return {&ray_x_[first], &ray_y_[first], &ray_z_[first], block_samples_};
    }

    std::shared_ptr<const Scene> scene_;
    int width_, height_, samples_ = 1;  ///< `samples_` per pixel
    double far_, noise_, tan_x_, tan_y_;
    Pose mount_;  ///< pose of the camera in the robot
    /// Pixels are in blocks of `block_width`; the last one of a row may extend beyond the picture. Sample s
    /// of pixel p of a block is number (block * samples_ + s) * block_width + p.
    std::size_t blocks_wide_ = 0, block_samples_ = 0;
    /// Directions of the samples in the frame of the robot, with length 1 along the optical axis.
    std::vector<float> ray_x_, ray_y_, ray_z_;
    std::vector<FloorPoints> floor_points_;  ///< one per floor of the scene
    std::vector<Extent> blocks_, rows_;
    std::vector<float> nearest_floor_;  ///< per block: the least depth of a floor
    Extent whole_;
    Bounds all_;  ///< bounds of everything that the camera can see
    Bounds low_;  ///< bounds of what it can see below z = low_height

    std::vector<int> own_blocks_;  ///< per block: its number in `own_`; -1 where nothing of the robot is seen
    std::vector<OwnBlock> own_;

    Grid solids_;  ///< the solids of the scene

    // ---- the current picture ----
    std::vector<std::size_t> near_;             ///< solids of the scene
    std::vector<Window> windows_;               ///< of the solids that may be visible, without own ones
    std::vector<std::array<double, 2>> reach_;  ///< while spans are computed
    std::vector<Span> spans_;                   ///< of the rows of all windows
    std::vector<Eigen::Array4f>
        colours_;  ///< of ground (0), then of the faces of own solids and of those with a window
    bool own_drawn_ = false;
    /// Per block: `bare`, the only face that is seen in it (or behind own solids), or `mixed`.
    std::vector<std::uint16_t> cover_;
    static constexpr std::uint16_t bare = 0, mixed = 65535;
};

}  // namespace forage::bug
