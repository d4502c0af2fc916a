// One robot of a simulated world: what it is, what it senses, what it was told.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/motion/motor.h"
#include "bug_interface/motion/physics.h"
#include "bug_interface/motion/reset.h"
#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/range_scan.h"
#include "bug_interface/simulation/trials.h"

namespace forage::bug {

/// What a robot knows at the end of a cycle.
struct BugSnapshot {
    Pose2 pose;  ///< m; yaw in (-pi, pi]
    std::vector<double>
        proximity;  ///< of scanner "laser", activity 0..1, cell 0 is the leftmost ray; empty without it
    std::vector<double> target;  ///< of scanner "laser_target", the same way: the light
    std::vector<std::uint8_t>
        image;  ///< rows from the top, red, green, blue; up to date only where asked for
    int image_width = 0, image_height = 0;  ///< pixels; 0: no camera

    void checkpoint(Archive& archive) { archive(pose, proximity, target, image); }
};

/// A part of a robot in its model's frame.
struct RobotVisual {
    Pose pose;
    VisualSolid visual;
    bool of_body = true;  ///< of the body itself, which the robot's own camera looks away from
};

/// A part of World, which alone makes, moves and asks robots; the members are public for it. They are used in
/// this order: the constructor; surround(), when all robots are there; then in every cycle `pose` is set, and
/// sense() and render() look at the world from it. What is said of a member holds from then on.
class Robot {
  public:
    /// A range scanner and what it sees. `around` ends with the outlines of the other robots, one for each
    /// element of `moving`, in that order; run() puts them where those robots are.
    struct Scan {
        struct Moving {
            std::size_t robot;
            Outline outline;  ///< in the frame of that robot
        };
        RangeScanner scanner;
        RandomStream noise;
        std::vector<Outline> around;  ///< what stands still, then what moves
        std::vector<Moving> moving;
        std::vector<double> ranges;  ///< m

        /// Scans from `body`, with all robots at `all`, into `cells`, one for each ray. `sample` counts the
        /// scans: the same one has the same noise.
        void run(const Pose2& body, std::uint64_t sample, bool with_noise, std::span<const Pose2> all,
                 std::span<double> cells);
    };

    /// Uses of random numbers; each is a stream of its own.
    enum Stream : std::uint32_t { motor_noise, proximity_noise, target_noise, image_noise, reset_draws };

    /// `model` has a robot_link(). An error when its body is no upright cylinder round the model's origin.
    Robot(const Model& model, std::uint64_t seed, Diagnostics& diagnostics);

    RandomStream random(Stream use) const { return {seed, "bug " + name, use}; }

    /// Makes the scanners and gives them what is around: what stands still in `world`, and of each robot i
    /// `robots[i]`, its solids in its own frame. `self` is the number of this robot, which does not see
    /// itself.
    void surround(const WorldDescription& world, const std::vector<std::vector<Solid>>& robots,
                  std::size_t self);
    /// Writes pose and scans of `sample` into the snapshot, with the robots at `all` (this one too).
    void sense(bool with_noise, std::uint64_t sample, std::span<const Pose2> all);
    /// Has no effect without a camera sensor, or when it is made already.
    void make_camera(std::shared_ptr<const Scene> scene);
    /// Writes the picture of `sample` into the snapshot, unless it is there already. `all` are the poses of
    /// `robots`, of which this is one. Has no effect before make_camera().
    void render(bool with_noise, std::uint64_t sample, std::span<const Pose2> all,
                const std::vector<Robot>& robots);

    /// What happens to it.
    void checkpoint(Archive& archive);

    // ---- what it is; constant ----
    std::string name;
    std::uint64_t seed;  ///< of the world
    Body body;
    double low = 0, high = 0;           ///< what the body reaches from and to, m above the floor
    std::vector<RobotVisual> visuals;   ///< what other cameras see of it
    Pose link_pose = Pose::Identity();  ///< of the body's link in the model; sensors stand on it
    std::vector<RangeSensor> range_sensors;
    std::optional<CameraSensor> camera_sensor;

    // ---- what happens to it ----
    Pose2 pose;            ///< at the end of the last cycle; while it is reset, a drawn one
    MotorCommand command;  ///< holds until the next
    RandomStream motor_random, image_random;
    std::optional<Reset> reset;             ///< empty: it is never put back
    std::optional<TrialLog> trials;         ///< always there once the world is made
    std::optional<Scan> proximity, target;  ///< of the sensors "laser" and "laser_target"
    std::optional<Camera> camera;           ///< made when a picture is first asked for
    BugSnapshot snapshot;
    bool wants_image = false;               ///< whether World::step() renders
    std::optional<std::uint64_t> rendered;  ///< the sample that the snapshot's image is of
    std::weak_ptr<void> claim;              ///< held by the module that drives it

  private:
    std::vector<float> picture_;
    std::vector<MovingVisual> moving_;
};

/// The pose in space of something that stands on the floor.
Pose in_space(const Pose2& pose);

}  // namespace forage::bug
