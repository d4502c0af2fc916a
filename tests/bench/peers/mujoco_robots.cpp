// The scenes in MuJoCo. Robots and balls are spheres with two sliding joints and a hinge each; there is no
// floor. Servos with a lag of 10 ms drive the robots; contacts are soft, with a time constant of 4 ms.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <mujoco/mujoco.h>
#include <unistd.h>

#include "tests/bench/peers/turns.h"

namespace {

class MujocoWorld {
  public:
    explicit MujocoWorld(const peers::Scene& scene) : robots_(scene.robots.size()), steps_(scene.steps) {
        char error[1000] = "";
        const auto file =
            std::filesystem::temp_directory_path() / ("peer_mujoco_" + std::to_string(getpid()) + ".xml");
        std::ofstream(file) << description(scene);
        model_ = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
        std::filesystem::remove(file);
        if (!model_) throw std::runtime_error(error);
        data_ = mj_makeData(model_);
        for (std::size_t i = 0; i < robots_; ++i) data_->qpos[3 * i + 2] = scene.robots[i].yaw;
        mj_forward(model_, data_);
        starts_ = scene.robots;
        starts_.insert(starts_.end(), scene.balls.begin(), scene.balls.end());
        ranges_.resize(robots_ * peers::rays);
    }
    ~MujocoWorld() { mj_deleteData(data_), mj_deleteModel(model_); }
    MujocoWorld(const MujocoWorld&) = delete;
    MujocoWorld& operator=(const MujocoWorld&) = delete;

    void command(std::size_t robot, const peers::Command& c) {
        data_->ctrl[3 * robot] = c.forward, data_->ctrl[3 * robot + 2] = c.turn;
    }
    void advance() {
        for (int s = 0; s < steps_; ++s) mj_step(model_, data_);
    }
    void scan() {
        for (std::size_t i = 0; i < robots_; ++i) {
            const peers::Pose at = pose(i);
            const int body = model_->jnt_bodyid[3 * i];
            for (int ray = 0; ray < peers::rays; ++ray) {
                const double angle = at.yaw + peers::ray_angle(ray);
                const mjtNum from[3] = {at.x, at.y, 0}, direction[3] = {std::cos(angle), std::sin(angle), 0};
                int geom = -1;
                const double distance = mj_ray(model_, data_, from, direction, nullptr, 1, body, &geom);
                ranges_[i * peers::rays + static_cast<std::size_t>(ray)] =
                    distance < 0 ? peers::max_range
                                 : std::clamp(distance, peers::min_range, peers::max_range);
            }
        }
    }
    peers::Pose pose(std::size_t i) const {
        const mjtNum* q = data_->qpos + 3 * i;
        return {starts_[i].x + q[0], starts_[i].y + q[1], q[2]};
    }
    peers::Pose ball(std::size_t i) const { return pose(robots_ + i); }
    double range(std::size_t robot, int ray) const {
        return ranges_[robot * peers::rays + static_cast<std::size_t>(ray)];
    }

  private:
    static void wall(std::ostream& out, double x, double y, double half_x, double half_y) {
        out << "<geom type='box' pos='" << x << ' ' << y << " 0' size='" << half_x << ' ' << half_y
            << " 1'/>\n";
    }
    static void body(std::ostream& out, const peers::Pose& pose, double radius, double mass, double damping,
                     const std::string& site) {
        out << "<body pos='" << pose.x << ' ' << pose.y << " 0'>\n";
        for (const char* slide : {"1 0 0", "0 1 0"})
            out << "<joint type='slide' axis='" << slide << "' damping='" << damping << "'/>\n";
        out << "<joint type='hinge' axis='0 0 1'/>\n<geom type='sphere' size='" << radius << "' mass='"
            << mass << "'/>\n"
            << site << "</body>\n";
    }
    static std::string description(const peers::Scene& scene) {
        std::ostringstream out;
        out.precision(17);
        out << "<mujoco><option timestep='" << scene.step()
            << "' gravity='0 0 0'/>\n<default><geom friction='" << peers::friction
            << " 0 0' solref='0.004 1'/></default>\n<worldbody>\n";
        const double t = peers::wall_thickness;
        for (const double sign : {-1.0, 1.0}) {
            wall(out, sign * (scene.half_x + t / 2), 0, t / 2, scene.half_y + t);
            wall(out, 0, sign * (scene.half_y + t / 2), scene.half_x + t, t / 2);
        }
        for (std::size_t i = 0; i < scene.robots.size(); ++i)
            body(out, scene.robots[i], peers::robot_radius, peers::robot_mass, 0,
                 "<site name='r" + std::to_string(i) + "'/>\n");
        for (const auto& ball : scene.balls)  // slows a ball of 1 m/s as much as the others' deceleration
            body(out, ball, peers::ball_radius, peers::ball_mass, peers::ball_mass * peers::ball_deceleration,
                 "");
        out << "</worldbody>\n<actuator>\n";
        for (std::size_t i = 0; i < scene.robots.size(); ++i)
            for (const char* servo :
                 {"gear='1 0 0 0 0 0' kv='500'", "gear='0 1 0 0 0 0' kv='500'", "gear='0 0 0 0 0 1' kv='10'"})
                out << "<velocity site='r" << i << "' " << servo << "/>\n";
        out << "</actuator></mujoco>\n";
        return out.str();
    }

    std::size_t robots_;
    int steps_;
    mjModel* model_ = nullptr;
    mjData* data_ = nullptr;
    std::vector<peers::Pose> starts_;
    std::vector<double> ranges_;
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<MujocoWorld>(argc, argv); }
