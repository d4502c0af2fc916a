// The sensors of one robot: range scanners and a camera.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/sensing/camera.h"
#include "bug_interface/sensing/range_scan.h"
#include "bug_interface/simulation/body_poses.h"
#include "bug_interface/simulation/communication.h"
#include "bug_interface/simulation/sensor_clock.h"
#include "bug_interface/world/description.h"
#include "core/base/random.h"

namespace forage::bug {

/// What a robot has sensed by the end of a cycle. Scans are activities in 0..1, which are high for near
/// surfaces, and cell 0 is the leftmost ray; they are empty when the robot does not have the sensor.
struct BugSnapshot {
    Pose2 pose;                     ///< m; yaw in (-pi, pi]
    std::vector<double> proximity;  ///< scan of the sensor "laser"
    std::vector<double> target;     ///< scan of the sensor "laser_target", which sees the light
    std::vector<double> gripper;    ///< scan of the sensor "laser_gripper"; updated only on request
    Message received{};             ///< the sum of the messages of all other robots, attenuated
    /// The image: height x width x 3 bytes (red, green, blue), in rows from the top; updated only on request.
    std::vector<std::uint8_t> image;
    int image_width = 0, image_height = 0;  ///< pixels; 0 when the robot has no camera

    /// Reads or writes everything except the image.
    void checkpoint(Archive& archive) { archive(pose, proximity, target, gripper, received); }
};

/// The purposes for which a robot uses random numbers. Each has its own stream, so that they do not affect
/// each other.
enum class RobotStream : std::uint32_t {
    motor_noise,
    proximity_noise,
    target_noise,
    image_noise,
    reset_draws,
    gripper_noise
};
RandomStream robot_stream(std::uint64_t seed, const std::string& robot, RobotStream use);

/// The sensors of one robot, and what they have measured. After the constructor, make_scanners() must be
/// called before anything is sensed. `sample` counts the cycles; the same sample has the same noise.
class RobotSensors {
  public:
    /// Uses the sensors of `link`, the link of the robot's body. `body` is the number of the robot among the
    /// bodies, and `noise` says whether the sensors are noisy.
    RobotSensors(const Link& link, const std::string& robot, std::size_t body, std::uint64_t seed,
                 bool noise);

    /// Makes the range scanners. `fixed` are the solids that never move, and `moving` are those that move
    /// with a body. A robot sees its own gripper but not its own central disc. `step` is the duration of a
    /// physics step, s.
    void make_scanners(std::span<const Solid> fixed, std::span<const MovingSolid> moving, double step);
    /// Makes the camera, a copy of one that belongs to the same robot. Has no effect when there is one.
    void make_camera(const Camera& like);

    /// The pose of the body's link in the robot. The poses of the sensors are relative to it.
    const Pose& link_pose() const { return link_pose_; }
    const std::vector<RangeSensor>& range_sensors() const { return range_sensors_; }
    const std::optional<CameraSensor>& camera_sensor() const { return camera_sensor_; }

    /// Requests the gripper's scans, or the images. What is not requested is not updated.
    void request_gripper_scan(bool requested) { gripper_requested_ = requested; }
    void request_image(bool requested) { image_requested_ = requested; }
    bool gripper_scan_requested() const { return gripper_requested_; }
    bool image_requested() const { return image_requested_; }

    /// Writes the pose and the scans of `sample` into the snapshot.
    void scan(std::uint64_t sample, const BodyPoses& poses);
    /// Writes the image of `sample` into the snapshot, unless it is there already. `visuals` are those that
    /// move. Has no effect before make_camera().
    void render(std::uint64_t sample, const BodyPoses& poses, MovingVisuals& visuals);
    /// Whether a sensor with a rate of its own is due at the simulated time `now`, s.
    bool due(double now) const;
    /// Updates the sensors that are due. The pose is updated with the proximity sensor, as in the original.
    void sense_due(double now, const BodyPoses& poses, MovingVisuals& visuals);
    void receive(const Message& message) { snapshot_.received = message; }
    /// The image of `sample` for display. The snapshot does not change. Valid until the next call; empty
    /// before make_camera().
    std::span<const std::uint8_t> view(std::uint64_t sample, const BodyPoses& poses, MovingVisuals& visuals);

    /// The snapshot of the current cycle.
    const BugSnapshot& snapshot() const { return snapshot_; }
    /// Stores the snapshot of `cycle` for `latency` cycles.
    void remember(std::uint64_t cycle, int latency);
    /// The snapshot of `latency` cycles before `cycle`; the first one for the first cycles.
    const BugSnapshot& delayed(std::uint64_t cycle) const {
        return history_.empty() ? snapshot_ : history_[(cycle + 1) % history_.size()];
    }

    void checkpoint(Archive& archive);

  private:
    /// A range scanner and the outlines that it sees.
    struct Scan {
        RangeScanner scanner;
        RandomStream noise;
        SensorClock clock;
        std::vector<Outline> fixed;  ///< outlines that never move
        Grid fixed_places;
        std::vector<MovingOutline> moving;       ///< in the order of their bodies
        std::vector<std::size_t> first_of_body;  ///< per body: its first moving outline; one more at the end
        std::vector<Outline> outlines;           ///< those in reach, in the world
        std::vector<double> ranges;              ///< m

        void measure(const Pose2& robot, std::uint64_t sample, bool with_noise, const BodyPoses& poses,
                     std::span<double> cells);
    };
    std::optional<Scan> make_scan(RangePurpose purpose, RobotStream use, std::span<const Solid> fixed,
                                  std::span<const MovingSolid> moving, double step,
                                  std::vector<double>& cells) const;
    std::size_t find_visible(const BodyPoses& poses, MovingVisuals& visuals);
    void take_picture(std::uint64_t sample, const BodyPoses& poses, MovingVisuals& visuals,
                      std::vector<std::uint8_t>& out);

    std::string robot_;
    std::size_t body_;
    std::uint64_t seed_;
    bool noise_;
    Pose link_pose_;
    std::vector<RangeSensor> range_sensors_;
    std::optional<CameraSensor> camera_sensor_;

    std::optional<Scan> proximity_, target_, gripper_;
    std::optional<Camera> camera_;
    std::optional<SensorClock> camera_clock_;
    RandomStream image_noise_;
    bool gripper_requested_ = false, image_requested_ = false;
    BugSnapshot snapshot_;
    std::vector<BugSnapshot> history_;       ///< ring buffer by cycle; empty without latency
    std::optional<std::uint64_t> rendered_;  ///< the sample of the snapshot's image

    std::vector<float> picture_;  ///< height x width x 3, 0..1
    std::vector<std::uint8_t> view_;
    std::vector<const VisualSolid*> visible_;  ///< the moving solids that may be in the picture
    std::vector<std::size_t> near_;            ///< bodies that may be in the picture
    std::vector<VisualSolid> own_;             ///< boxes of its gripper that the camera has looked up
    std::vector<Pose2> own_hinges_;            ///< where they were then
};

}  // namespace forage::bug
