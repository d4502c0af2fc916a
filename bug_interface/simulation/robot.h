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
};

/// A part of a robot in its model's frame.
struct RobotVisual {
    Pose pose;
    VisualSolid visual;
    bool of_body = true;  ///< of the body itself, which the robot's own camera looks away from
};

/// Built and moved by World.
class Robot {
  public:
    /// What its range scanners see. An outline of another robot is in that one's frame.
    struct Scan {
        struct Moving {
            std::size_t robot;
            Outline outline;
        };
        RangeScanner scanner;
        RandomStream noise;
        std::vector<Outline> around;  ///< what stands still, then what moves
        std::vector<Moving> moving;
        std::vector<double> ranges;  ///< m

        void run(const Pose2& body, std::uint64_t sample, bool with_noise, std::span<const Pose2> all,
                 std::span<double> cells);
    };

    /// Uses of random numbers; each is a stream of its own.
    enum Stream : std::uint32_t { motor_noise, proximity_noise, target_noise, image_noise, reset_draws };

    /// `model` has a robot_link(). An error when its body is no upright cylinder round the model's origin.
    Robot(const Model& model, std::uint64_t seed, Diagnostics& diagnostics);

    RandomStream random(Stream use) const { return {seed, "bug " + name, use}; }
    /// Gives the scanners what is around: `still` stands still, `others[i]` are the solids of robot i in its
    /// frame.
    void surround(const WorldDescription& world, const std::vector<std::vector<Solid>>& others,
                  std::size_t self);
    void sense(bool with_noise, std::uint64_t sample, std::span<const Pose2> all);
    void make_camera(std::shared_ptr<const Scene> scene);
    void render(bool with_noise, std::uint64_t sample, std::span<const Pose2> all,
                const std::vector<Robot>& robots);

    std::string name;
    std::uint64_t seed;
    Body body;
    double low = 0, high = 0;  ///< what the body reaches from and to, m above the floor
    Pose2 pose;                ///< as it is seen at the end of a cycle
    std::vector<RobotVisual> visuals;
    Pose link_pose = Pose::Identity();
    std::vector<RangeSensor> range_sensors;
    std::optional<CameraSensor> camera_sensor;

    MotorCommand command;
    RandomStream motor_random, image_random;
    std::optional<Reset> reset;
    std::optional<TrialLog> trials;
    std::optional<Scan> proximity, target;
    std::optional<Camera> camera;
    BugSnapshot snapshot;
    bool wants_image = false;
    std::optional<std::uint64_t> rendered;  ///< the sample that the snapshot's image is of
    std::weak_ptr<void> claim;

  private:
    std::vector<float> picture_;
    std::vector<MovingVisual> moving_;
};

/// The pose in space of something that stands on the floor.
Pose in_space(const Pose2& pose);

}  // namespace forage::bug
