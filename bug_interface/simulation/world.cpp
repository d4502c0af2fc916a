#include "bug_interface/simulation/world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace forage::bug {
namespace {

constexpr double speed_noise = 0.005;  ///< the velocity plugin adds up to this, m/s and rad/s

void warn_about_what_is_left_out(const WorldDescription& world, Diagnostics& diagnostics) {
    for (const Model& model : world.models) {
        for (const Plugin& p : model.plugins)
            if (p.filename != "libvel_plugin.so" && p.filename != "libreset_plugin.so" &&
                p.filename != "libtarget_plugin.so")
                diagnostics.warning(p.where,
                                    fmt::format("plugin '{}' is not known here and does nothing", p.filename),
                                    "known are libvel_plugin.so and libreset_plugin.so");
        if (!model.is_static && !robot_link(model) && !solids_of(model).empty())
            diagnostics.warning(
                model.where,
                fmt::format("model '{}' is movable, but here it stays where it is and nothing bumps into it",
                            model.name),
                "add <static>true</static> to make it an obstacle");
    }
}

}  // namespace

World::World(const WorldDescription& description, const WorldOptions& options)
    : description_(description), options_(options) {
    const double factor = options.real_time_factor.value_or(description.step * description.update_rate);
    substeps_per_cycle_ = factor / (options.cycles_per_second * description.step);
}

std::unique_ptr<World> World::make(const WorldDescription& description, const WorldOptions& options,
                                   Diagnostics& diagnostics) {
    const int errors_before = diagnostics.errors();
    if (!(options.cycles_per_second > 0) || !(options.real_time_factor.value_or(1) > 0)) {
        diagnostics.error(
            {}, "a simulated world needs a number of cycles per second and a real time factor above 0",
            "give the system's cyclesPerSecond, or choose one on the command line");
        return nullptr;
    }
    std::unique_ptr<World> world(new World(description, options));
    world->build(diagnostics);
    if (diagnostics.errors() > errors_before) return nullptr;
    world->scan();
    return world;
}

bool World::build(Diagnostics& diagnostics) {
    warn_about_what_is_left_out(description_, diagnostics);
    const int errors_before = diagnostics.errors();
    plan_ = find_reset(description_, diagnostics);
    targets_ = targets_of(description_);
    std::vector<std::vector<Solid>> solids;  // of each robot in its own frame
    double low = 0, high = 0;
    for (const Model& model : description_.models) {
        if (!robot_link(model)) continue;
        if (find(model.name))
            diagnostics.error(model.where, fmt::format("there are two robots named '{}'", model.name),
                              "give each <include> a <name> of its own");
        Robot& robot = robots_.emplace_back(model, options_.seed, diagnostics);
        if (plan_ && has_plugin(model, "libreset_plugin.so"))
            robot.reset.emplace(*plan_, robot.random(Robot::reset_draws));
        robot.trials.emplace(targets_);
        low = robots_.size() == 1 ? robot.low : std::min(low, robot.low);
        high = std::max(high, robot.high);
        Model at_origin = model;
        at_origin.pose = Pose::Identity();
        solids.push_back(solids_of(at_origin));
    }
    if (diagnostics.errors() > errors_before) return false;

    std::vector<Body> bodies;
    for (const Robot& robot : robots_) bodies.push_back(robot.body);
    physics_ = std::make_unique<Physics>(obstacles_of(description_, low, high), bodies, description_.step);
    drives_.resize(robots_.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        robots_[i].surround(description_, solids, i);
        physics_->place(i, robots_[i].pose);
        poses_.push_back(robots_[i].pose = physics_->pose(i));
        robots_[i].trials->begin(robots_[i].pose, 0);
    }
    return true;
}

std::uint64_t World::substeps_before(std::uint64_t cycle) const {
    // 80 substeps per cycle may be 79.999999 in floating point.
    return static_cast<std::uint64_t>(std::floor(static_cast<double>(cycle) * substeps_per_cycle_ + 1e-4));
}

void World::step() {
    advance_bodies();
    scan();
    render();
}

/// A substep, in the original's order: the velocity plugin, the reset plugin, then the motion.
void World::advance_bodies() {
    const std::uint64_t last = substeps_before(cycle_ + 1);
    for (; substep_ < last; ++substep_) {
        for (std::size_t i = 0; i < robots_.size(); ++i) {
            Robot& robot = robots_[i];
            if (in_reset(i)) {
                drives_[i] = {};
                continue;
            }
            drives_[i] = robot.command;
            if (options_.noise) {
                std::array<double, 2> u{};
                robot.motor_random.uniform(substep_, u);
                drives_[i].forward += (2 * u[0] - 1) * speed_noise;
                drives_[i].turn += (2 * u[1] - 1) * speed_noise;
            }
        }
        physics_->step(drives_);
        for (std::size_t i = 0; i < robots_.size(); ++i)
            if (!resetting(i)) robots_[i].trials->follow(physics_->pose(i));
    }
    for (std::size_t i = 0; i < robots_.size(); ++i)
        poses_[i] = robots_[i].pose = resetting(i) ? robots_[i].reset->glimpse() : physics_->pose(i);
    ++cycle_;
}

bool World::in_reset(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (!robot.reset) return false;
    switch (robot.reset->substep(physics_->pose(bug))) {
        case Reset::Phase::none:
            return false;
        case Reset::Phase::begin:
            robot.trials->finish(physics_->pose(bug), cycle_ + 1);
            physics_->lift(bug);
            return true;
        case Reset::Phase::hold:
            return true;
        case Reset::Phase::end:
            physics_->place(bug, robot.reset->start());
            robot.trials->begin(physics_->pose(bug),
                                substep_ + 1 < substeps_before(cycle_ + 1) ? cycle_ : cycle_ + 1);
            return true;
    }
    return true;
}

void World::scan() {
    for (Robot& robot : robots_) robot.sense(options_.noise, cycle_, poses_);
}

void World::render() {
    for (Robot& robot : robots_)
        if (robot.wants_image) robot.render(options_.noise, cycle_, poses_, robots_);
}

void World::checkpoint(Archive& archive) {
    archive.same(robots_.size(), "the number of robots");
    archive(cycle_, substep_);
    for (Robot& robot : robots_) robot.checkpoint(archive);
    archive(poses_, *physics_);
}

std::vector<std::string> World::bug_names() const {
    std::vector<std::string> names;
    for (const Robot& robot : robots_) names.push_back(robot.name);
    return names;
}

std::optional<std::size_t> World::find(std::string_view bug) const {
    for (std::size_t i = 0; i < robots_.size(); ++i)
        if (robots_[i].name == bug) return i;
    return {};
}

void World::make_camera(std::size_t bug) {
    if (!robots_[bug].camera_sensor || robots_[bug].camera) return;
    if (!scene_) scene_ = std::make_shared<const Scene>(description_, bug_names());
    robots_[bug].make_camera(scene_);
}

std::span<const std::uint8_t> World::image(std::size_t bug) {
    make_camera(bug);
    robots_[bug].render(options_.noise, cycle_, poses_, robots_);
    return robots_[bug].snapshot.image;
}

void World::need_image(std::size_t bug, bool needed) {
    robots_[bug].wants_image = needed;
    if (needed) image(bug);
}

Eigen::Vector2d World::looks_at(std::size_t bug) const {
    const Robot& robot = robots_[bug];
    const Eigen::Vector2d here(robot.pose.x, robot.pose.y);
    if (!robot.camera_sensor) return here;
    const Pose camera = robot.link_pose * robot.camera_sensor->pose;
    const Eigen::Vector3d axis = camera.linear().col(0), at = camera.translation();
    if (axis.z() >= 0) return here;
    const Eigen::Vector3d floor = at - at.z() / axis.z() * axis;
    return here + Eigen::Rotation2Dd(robot.pose.yaw) * floor.head<2>();
}

std::shared_ptr<void> World::claim(std::size_t bug) {
    if (!robots_[bug].claim.expired()) return nullptr;
    auto token = std::make_shared<int>();
    robots_[bug].claim = token;
    return token;
}

Trial World::current_trial(std::size_t bug) const {
    return robots_[bug].trials->current(robots_[bug].pose, cycle_);
}

}  // namespace forage::bug
