// One robot of a simulated world: what it is, what it senses, what it was told.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/motion/gripper.h"
#include "bug_interface/motion/motor.h"
#include "bug_interface/motion/physics.h"
#include "bug_interface/motion/reset.h"
#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/range_scan.h"
#include "bug_interface/simulation/heights.h"
#include "bug_interface/simulation/sensor_clock.h"
#include "bug_interface/simulation/body_poses.h"
#include "bug_interface/simulation/trials.h"
#include "bug_interface/simulation/communication.h"

namespace forage::bug {

/// What a robot knows at the end of a cycle.
struct BugSnapshot {
    Pose2 pose;  ///< m; yaw in (-pi, pi]
    std::vector<double>
        proximity;  ///< of scanner "laser", activity 0..1, cell 0 is the leftmost ray; empty without it
    std::vector<double> target;  ///< of scanner "laser_target", the same way: the light
    std::vector<double>
        gripper;         ///< of scanner "laser_gripper", the same way; up to date only where asked for
    Message received{};  ///< the sum of the messages of all other robots, attenuated
    std::vector<std::uint8_t>
        image;  ///< rows from the top, red, green, blue; up to date only where asked for
    int image_width = 0, image_height = 0;  ///< pixels; 0: no camera

    /// Without the image, which may be there for onlookers only.
    void checkpoint(Archive& archive) { archive(pose, proximity, target, gripper, received); }
};

/// A part of World, which alone makes, moves and asks robots; the members are public for it. They are used in
/// this order: the constructor; surround(), when all robots are there; then in every cycle sense() and
/// render() look at the world at the body poses. What is said of a member holds from then on.
class Robot {
  public:
    /// A range scanner and what it sees.
    struct Scan {
        RangeScanner scanner;
        RandomStream noise;
        SensorClock clock;            ///< at the rate that the file gives
        std::size_t still = 0;        ///< the first of `around` stand still
        std::vector<Outline> around;  ///< then what moves, where it is now
        std::vector<MovingOutline> moving;
        std::vector<double> ranges;  ///< m

        /// Scans from `body` into `cells`, one for each ray. `sample` counts the scans: the same one has the
        /// same noise.
        void run(const Pose2& body, std::uint64_t sample, bool with_noise, const BodyPoses& poses,
                 std::span<double> cells);
    };
    /// A part of it that moves on hinges or is fixed beside the round body.
    struct Limb {
        Outline home;  ///< in the robot's frame, with its hinges at 0
        int hinge = -1;
    };
    /// Uses of random numbers; each is a stream of its own.
    enum Stream : std::uint32_t {
        motor_noise,
        proximity_noise,
        target_noise,
        image_noise,
        reset_draws,
        gripper_noise
    };

    /// `model` has a robot_link(). An error when its body is no upright cylinder round the model's origin,
    /// and when there are too many `heights`.
    Robot(const Model& model, std::size_t number, std::uint64_t seed, Heights& heights,
          Diagnostics& diagnostics);

    RandomStream random(Stream use) const { return {seed, "bug " + name, use}; }

    /// Makes the scanners. `still`: what stands still, `moving`: what moves, both solids cut at all heights
    /// by whoever asks; a robot does not see its own body, but its gripper. `step`: of the physics, s.
    void surround(std::span<const Solid> still, std::span<const MovingSolid> moving, double step);
    /// Writes pose and scans of `sample` into the snapshot.
    void sense(bool with_noise, std::uint64_t sample, const BodyPoses& poses);
    /// Whether a sensor looks now that has a rate of its own. `now`: s of the world.
    bool due(double now) const;
    /// What is due now looks and writes into the snapshot. The pose comes with the proximity sensor, as in
    /// the original.
    void sense_due(double now, bool with_noise, const BodyPoses& poses, std::span<const MovingVisual> visuals);
    /// Has no effect without a camera sensor, or when it is made already.
    void make_camera(std::shared_ptr<const Scene> scene);
    /// Writes the picture of `sample` into the snapshot, unless it is there already. `visuals`: what moves,
    /// with visuals placed in the world.
    /// Has no effect before make_camera().
    void render(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                std::span<const MovingVisual> visuals);
    /// What the camera sees at `poses`, for onlookers: the snapshot stays as it is. Valid until the next
    /// call; empty before make_camera().
    std::span<const std::uint8_t> view(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                                       std::span<const MovingVisual> visuals);
    /// Turns the hinges for a substep of `step` s, as far as nothing is in the way.
    void move_gripper(Physics& physics, double step);

    /// What happens to it.
    void checkpoint(Archive& archive);

    // ---- what it is; constant ----
    std::string name;
    std::size_t number;  ///< of this robot
    std::uint64_t seed;  ///< of the world
    Body body;
    std::vector<MovingSolid> solids;    ///< its collision shapes
    std::vector<MovingVisual> visuals;    ///< what cameras see of it
    std::vector<Limb> limbs;            ///< of `body.parts`
    Pose link_pose = Pose::Identity();  ///< of the body's link in the model; sensors stand on it
    std::vector<RangeSensor> range_sensors;
    std::optional<CameraSensor> camera_sensor;

    // ---- what happens to it ----
    Pose2 pose;            ///< at the end of the last cycle; while it is reset, a drawn one
    MotorCommand command;  ///< holds until the next
    Hinges hinges;
    RandomStream motor_random, image_random;
    std::optional<Reset> reset;      ///< empty: it is never put back
    std::optional<TrialLog> trials;  ///< always there once the world is made
    std::optional<Scan> proximity, target,
        gripper;                   ///< of the sensors "laser", "laser_target", "laser_gripper"
    std::optional<Camera> camera;  ///< made when a picture is first asked for
    Transceiver transceiver;
    BugSnapshot snapshot;
    std::vector<BugSnapshot> history;  ///< the last ones, where modules get them late
    bool wants_image = false;          ///< whether World::step() renders
    bool wants_gripper_scan = false;   ///< whether the gripper's rays are scanned
    std::optional<SensorClock> camera_clock;
    std::optional<std::uint64_t> rendered;  ///< the sample that the snapshot's image is of
    std::weak_ptr<void> claim;              ///< held by the module that drives it

  private:
    void take_picture(bool with_noise, std::uint64_t sample, const BodyPoses& poses,
                      std::span<const MovingVisual> visuals, std::vector<std::uint8_t>& out);

    std::vector<float> picture_;
    std::vector<std::uint8_t> view_;
    std::vector<const VisualSolid*> moving_;
    std::vector<std::pair<std::size_t, Outline>> swung_;
};

}  // namespace forage::bug
