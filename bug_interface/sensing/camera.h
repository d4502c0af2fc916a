// The camera: small colour pictures of a scene, drawn ray by ray.
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
/// The rays are constant in the robot's frame, and so is the floor point of each: a picture of bare floor
/// only turns and shifts those points and looks up the texture. Solids are tested ray by ray where their
/// bounds meet a tile of the picture.
class Camera {
  public:
    /// `link_in_model`: pose of the camera's link in the model whose pose render() gets. Every pixel is the
    /// mean of samples_per_axis^2 rays (1 to 4 per axis).
    Camera(const CameraSensor& sensor, const Pose& link_in_model, std::shared_ptr<const Scene> scene,
           int samples_per_axis = 2);

    int width() const { return width_; }    ///< pixels
    int height() const { return height_; }  ///< pixels

    /// Draws the scene and `moving` from the robot at `body`. rgb: height x width x 3 values in 0..1, row 0
    /// is the top (far), column 0 the left; no noise. Allocates nothing, once it has seen as many solids.
    void render(const Pose2& body, std::span<const VisualSolid* const> moving, std::span<float> rgb);

    /// Rounds to 8 bits after adding noise: one normal number per pixel, the same in its three channels.
    /// `sample` counts this camera's pictures.
    void quantise(std::span<const float> rgb, std::span<std::uint8_t> out, const RandomStream& random,
                  std::uint64_t sample) const;

    /// Where the middle of pixel (column, row) meets the plane z = 0, in the robot's frame, m. Empty above
    /// the horizon.
    std::optional<Eigen::Vector2d> floor_point(int column, int row) const;

  private:
    static constexpr int tile_width = 32;    ///< pixels of one row that are drawn together
    static constexpr int segment_width = 8;  ///< pixels that are looked at together for being of one colour
    static constexpr int max_samples = 16;   ///< per pixel
    static constexpr double low_height =
        0.02;  ///< m; discs and strips on the floor lie below: tighter bounds for them

    /// Where everything is that some rays can meet: in the box, and in the sphere round it. Robot's frame.
    struct Bounds {
        Eigen::AlignedBox3d box;
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double radius = 0;
    };
    /// What some rays meet of the only floor lies in the rectangle with this middle and these half sides,
    /// robot's frame, m.
    struct Extent {
        float x = 0, y = 0, half_x = 0, half_y = 0;
    };
    struct Tile {
        int row = 0, column = 0, pixels = 0;
        std::size_t first = 0;  ///< of its samples: sample s of pixel p is first + s * pixels + p
        Bounds all;             ///< of everything
        Bounds low;             ///< of what lies below z = low_height
        Extent extent;          ///< of all its samples
        std::array<Extent, tile_width / segment_width> segments;  ///< of segment_width pixels each
        bool reaches_floor = true;  ///< do all its rays meet all floors, were these without end?
    };
    /// Of one floor: where every sample meets it, in the robot's frame; infinity where it does not.
    struct FloorPoints {
        std::vector<float> x, y;
        std::vector<float> depth;  ///< along the camera's axis, m
    };
    struct View;  ///< one picture's pose of the robot
    /// The pixels on which a solid may be seen; ends are one past the last.
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
    const float* even_colour(const View& view, const Extent& extent, float* colour) const;
    bool draw_bare_floor(const View& view, const Tile& tile, float* rgb) const;
    void draw_textured(const View& view, const Tile& tile, int first_pixel, int pixels, float* rgb) const;
    void draw_all(const View& view, const Tile& tile, float* rgb) const;

    std::shared_ptr<const Scene> scene_;
    int width_, height_, samples_ = 1;  ///< samples per pixel
    double far_, noise_, tan_x_, tan_y_;
    Pose mount_;  ///< of the camera in the model
    std::vector<Tile> tiles_;
    Tile whole_;                                ///< bounds of all tiles
    std::vector<float> ray_x_, ray_y_, ray_z_;  ///< of every sample, robot's frame; 1 along the camera's axis
    std::vector<FloorPoints> floor_points_;     ///< one per floor of the scene
    std::vector<Window> windows_;               ///< of what is in one picture
};

}  // namespace forage::bug
