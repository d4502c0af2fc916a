// The robots of the comparison: where they start, how they are driven, what they sense. Every simulator runs
// the same scenes. Metres, radians, seconds and kilograms.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace peers {

inline constexpr double cycle = 0.08;  ///< time between two commands, and between two scans
inline constexpr double robot_radius = 0.2, robot_mass = 5, robot_inertia = 0.1;
inline constexpr double ball_radius = 0.1, ball_mass = 0.5, ball_deceleration = 0.98;
inline constexpr double friction = 0.1;  ///< Coulomb coefficient of all surfaces
inline constexpr double wall_thickness = 0.2;
inline constexpr int rays = 16;
inline constexpr double first_ray = -3, last_ray = 3, min_range = 0.205, max_range = 2;

/// Angle of a ray to the left of the robot's heading.
inline double ray_angle(int ray) { return first_ray + ray * (last_ray - first_ray) / (rays - 1); }

struct Pose {
    double x = 0, y = 0, yaw = 0;
};
struct Command {
    double forward = 0, turn = 0;  ///< m/s, rad/s
};

/// A rectangle of walls around the origin, with robots and balls.
struct Scene {
    std::string name;
    double half_x = 0, half_y = 0;  ///< half of the inner width and height
    std::vector<Pose> robots, balls;
    int steps = 80;  ///< physics steps per cycle
    double step() const { return cycle / steps; }
};

/// open: circles with a radius of 1 m that are out of reach of the walls; wall: along the upper wall, to and
/// fro; corner: into the upper right corner; crowd: eight robots among 16 balls.
inline Scene make_scene(const std::string& name) {
    if (name == "open") return {name, 6, 6, {{0, -1, 0}}, {}};
    if (name == "wall") return {name, 6, 4, {{0, 3.75, 0.35}}, {}};
    if (name == "corner") return {name, 6, 4, {{5.5, 3.5, 0.7}}, {}};
    Scene crowd{name, 4, 4, {}, {}};
    for (int i = 0; i < 8; ++i)
        crowd.robots.push_back({3 * std::cos(M_PI * i / 4), 3 * std::sin(M_PI * i / 4), M_PI * i / 4});
    for (int i = 0; i < 16; ++i) crowd.balls.push_back({i % 4 - 1.5, i / 4 - 1.5, 0});
    return crowd;
}

/// Gives the commands: those of `wall` and `corner` steer towards a heading, so that robots which contacts
/// turned stay on their way; those of `crowd` are random and hold for 2 s.
class Driver {
  public:
    explicit Driver(const Scene& scene) : scene_(scene), random_(scene.robots.size()) {}

    Command command(std::size_t robot, const Pose& pose) {
        if (scene_.name == "open") return {0.5, 0.5};
        if (scene_.name == "crowd") return random_command(robot);
        if (scene_.name == "wall" && std::abs(pose.x) > 4) heading_ = pose.x > 0 ? M_PI - 0.35 : 0.35;
        const double error = std::remainder(heading_ - pose.yaw, 2 * M_PI);
        return {0.5, std::clamp(2 * error, -1.5, 1.5)};
    }

  private:
    struct Random {
        Command command;
        int cycles = 0;
    };
    Command random_command(std::size_t robot) {
        Random& r = random_[robot];
        const auto uniform = [&] { return static_cast<double>(generator_()) / 4294967296.0; };
        if (r.cycles++ % 25 == 0)
            r.command.forward = 1.4 * uniform() - 0.2, r.command.turn = 3 * uniform() - 1.5;
        return r.command;
    }

    Scene scene_;
    double heading_ = scene_.name == "wall" ? 0.35 : M_PI / 4;
    std::vector<Random> random_;
    std::mt19937 generator_{3};
};

}  // namespace peers
