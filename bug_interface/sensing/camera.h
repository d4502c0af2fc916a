// The camera: small colour pictures of a scene, rendered by ray casting.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bug_interface/sensing/scene.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// A pinhole camera on a robot that moves in the plane.
///
/// The rays are constant in the frame of the robot, and so are the points where they meet the floor. A
/// picture of bare floor only needs the transform of these points into the texture. Solids are tested ray by
/// ray in the tiles of the picture that their bounds meet.
class Camera {
  public:
    /// `link_pose` is the pose of the camera's link in the robot. Each pixel is the mean of
    /// samples_per_axis^2 rays. Throws std::invalid_argument when `samples_per_axis` is not 1 to 4.
    Camera(const CameraSensor& sensor, const Pose& link_pose, std::shared_ptr<const Scene> scene,
           int samples_per_axis = 2);

    int width() const { return width_; }    ///< pixels
    int height() const { return height_; }  ///< pixels

    /// Renders the scene and the solids `moving` from a robot at the pose `robot`, without noise. `rgb` has
    /// height x width x 3 values in 0..1; row 0 is the top (far), column 0 the left. Allocates memory only
    /// when there are more solids than ever before.
    void render(const Pose2& robot, std::span<const VisualSolid* const> moving, std::span<float> rgb);

    /// Adds noise and rounds to 8 bits. A normally distributed random number is drawn for each pixel and
    /// added to its three channels. `sample` is the number of the picture; the same sample has the same
    /// noise.
    void quantise(std::span<const float> rgb, std::span<std::uint8_t> out, const RandomStream& random,
                  std::uint64_t sample) const;

    /// The point where the ray through the centre of pixel (column, row) meets the plane z = 0, in the frame
    /// of the robot, m. Empty above the horizon.
    std::optional<Eigen::Vector2d> floor_point(int column, int row) const;

  private:
    static constexpr int tile_width = 32;       ///< pixels of one row that are rendered together
    static constexpr int segment_width = 8;     ///< pixels that are tested together for a uniform colour
    static constexpr int max_samples = 16;      ///< largest number of samples per pixel
    static constexpr double low_height = 0.02;  ///< m; solids below it (paint) have tighter bounds

    /// A box and a sphere that both contain all points that some rays can see, in the frame of the robot.
    struct Bounds {
        Eigen::AlignedBox3d box;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double radius = 0;
    };
    /// The bounding rectangle of the points where some rays meet the floor, when there is only one; in the
    /// frame of the robot, m.
    struct Extent {
        float x = 0, y = 0;            ///< centre
        float half_x = 0, half_y = 0;  ///< half the sides
    };
    struct Tile {
        int row = 0, column = 0, pixels = 0;
        std::size_t first = 0;  ///< its first sample; sample s of pixel p is first + s * pixels + p
        Bounds all;             ///< bounds of everything that the samples can see
        Bounds low;             ///< bounds of what they can see below z = low_height
        Extent extent;          ///< extent of all samples
        std::array<Extent, tile_width / segment_width> segments;  ///< extents of segment_width pixels each
        bool reaches_floor = true;  ///< whether all rays would meet all floors if the floors were infinite
    };
    /// The points where all samples meet one floor, in the frame of the robot, m; infinity where they do not.
    struct FloorPoints {
        std::vector<float> x, y;
        std::vector<float> depth;  ///< along the optical axis, m
    };
    struct View;  ///< values that are constant in one picture
    /// The pixels in which a solid may be visible; the ends are one past the last.
    struct Window {
        const VisualSolid* visual = nullptr;
        int first_column = 0, end_column = 0, first_row = 0, end_row = 0;
    };

    Eigen::Vector3d ray(double column, double row) const;
    void make_samples(int samples_per_axis);
    void make_floor_points();
    void make_bounds(double lowest);
    Bounds bounds(std::size_t first, std::size_t count, double lowest, double highest) const;
    static bool sees(const View& view, const Tile& tile, const VisualSolid& visual);
    static bool sees(const View& view, const Tile& tile, const Window& window);
    Window window(const View& view, const VisualSolid& visual) const;
    void make_extents();
    Extent extent(const Tile& tile, int first_pixel, int pixels) const;
    static Extent extent(const Eigen::AlignedBox2f& box);
    const float* uniform_colour(const View& view, const Extent& extent, float* colour) const;
    bool draw_bare_floor(const View& view, const Tile& tile, float* rgb) const;
    void draw_textured(const View& view, const Tile& tile, int first_pixel, int pixels, float* rgb) const;
    void draw_all(const View& view, const Tile& tile, float* rgb) const;

    std::shared_ptr<const Scene> scene_;
    int width_, height_, samples_ = 1;  ///< `samples_` per pixel
    double far_, noise_, tan_x_, tan_y_;
    Pose mount_;  ///< pose of the camera in the robot
    std::vector<Tile> tiles_;
    Tile whole_;  ///< bounds of all tiles
    /// Directions of the samples in the frame of the robot, with length 1 along the optical axis.
    std::vector<float> ray_x_, ray_y_, ray_z_;
    std::vector<FloorPoints> floor_points_;  ///< one per floor of the scene
    std::vector<Window> windows_;            ///< windows of the solids in the current picture
};

}  // namespace forage::bug
