// The scenes in Forage, with the noise of its motors, which the other simulators do not have.
#include <memory>
#include <stdexcept>

#include "bug_interface/simulation/world.h"
#include "tests/bench/peers/turns.h"

namespace {

using namespace forage;

class ForageWorld {
  public:
    explicit ForageWorld(const peers::Scene& scene) {
        bug::WorldDescription description;
        description.step = scene.step();
        bug::WorldOptions options;
        options.cycles_per_second = 1 / peers::cycle, options.real_time_factor = 1;
        const double t = peers::wall_thickness;
        for (const double sign : {-1.0, 1.0}) {
            add_wall(description, sign * (scene.half_x + t / 2), 0, t, 2 * scene.half_y + 2 * t);
            add_wall(description, 0, sign * (scene.half_y + t / 2), 2 * scene.half_x + 2 * t, t);
        }
        for (const auto& pose : scene.robots) add_robot(description, pose);
        for (const auto& pose : scene.balls) add_ball(description, pose);
        Diagnostics diagnostics;
        world_ = bug::World::make(description, options, diagnostics);
        if (!world_) throw std::runtime_error(format(diagnostics));
    }

    void command(std::size_t robot, const peers::Command& c) { world_->command(robot, {c.forward, c.turn}); }
    void advance() { world_->advance_bodies(); }
    void scan() { world_->scan(), world_->render(); }
    peers::Pose pose(std::size_t robot) const { return in_scene(world_->pose(robot)); }
    peers::Pose ball(std::size_t i) const { return in_scene(*world_->movable_object_pose(i)); }
    double range(std::size_t robot, int ray) const {
        return peers::max_range * (1 - world_->snapshot(robot).proximity[static_cast<std::size_t>(ray)]);
    }

  private:
    static peers::Pose in_scene(const bug::Pose2& p) { return {p.x, p.y, p.yaw}; }

    /// A model of one link with one solid, which stands on the floor.
    static bug::Model& add(bug::WorldDescription& world, const peers::Pose& pose, const bug::Shape& shape,
                           double mass, double inertia) {
        bug::Model model;
        model.name = "model_" + std::to_string(world.models.size());
        model.pose = bug::Pose(Eigen::Translation3d(pose.x, pose.y, 0) *
                               Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()));
        bug::Link link;
        link.name = "body", link.mass = mass, link.inertia_z = inertia;
        link.pose.translation().z() = shape.size.z() / 2;
        link.collisions.push_back({{}, "collision", bug::Pose::Identity(), shape, peers::friction});
        model.links.push_back(link);
        return world.models.emplace_back(model);
    }
    static void add_wall(bug::WorldDescription& world, double x, double y, double width, double height) {
        add(world, {x, y, 0}, {bug::ShapeKind::box, {width, height, 0.5}}, 1, 1).is_static = true;
    }
    static void add_ball(bug::WorldDescription& world, const peers::Pose& pose) {
        const double diameter = 2 * peers::ball_radius;
        add(world, pose, {bug::ShapeKind::sphere, {diameter, diameter, diameter}}, peers::ball_mass,
            0.4 * peers::ball_mass * peers::ball_radius * peers::ball_radius);
    }
    static void add_robot(bug::WorldDescription& world, const peers::Pose& pose) {
        const double diameter = 2 * peers::robot_radius;
        bug::Model& model = add(world, pose, {bug::ShapeKind::cylinder, {diameter, diameter, 0.2}},
                                peers::robot_mass, peers::robot_inertia);
        bug::RangeSensor sensor;
        sensor.name = "laser", sensor.rays = peers::rays;
        sensor.first_angle = peers::first_ray, sensor.last_angle = peers::last_ray;
        sensor.min_range = peers::min_range, sensor.max_range = peers::max_range;
        model.links.front().name = "bug";
        model.links.front().range_sensors.push_back(sensor);
        model.plugins.push_back({{}, "velocity", "libvel_plugin.so"});
    }

    std::unique_ptr<bug::World> world_;
};

}  // namespace

int main(int argc, char** argv) { return peers::serve<ForageWorld>(argc, argv); }
