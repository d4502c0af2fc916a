#include "bug_interface/simulation/world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

constexpr double speed_noise = 0.005;  ///< the velocity plugin adds up to this, m/s and rad/s

void warn_about_what_is_left_out(const WorldDescription& world, Diagnostics& diagnostics) {
    for (const Model& model : world.models)
        for (const Plugin& p : model.plugins)
            if (p.filename != "libvel_plugin.so" && p.filename != "libreset_plugin.so" &&
                p.filename != "libtarget_plugin.so")
                diagnostics.warning(p.where,
                                    fmt::format("plugin '{}' is not known here and does nothing", p.filename),
                                    "known are libvel_plugin.so, libreset_plugin.so and libtarget_plugin.so");
}

/// A world without what moves, for what stands still.
WorldDescription without_movers(WorldDescription world) {
    std::erase_if(world.models, [](const Model& m) { return robot_link(m) || is_loose(m); });
    return world;
}

/// The challenge's resource: a blue ball.
Model resource(int number) {
    Model model;
    model.name = fmt::format("resource_{}", number);
    model.plugins.push_back({{}, "target", "libtarget_plugin.so"});
    Link link;
    link.name = "body", link.mass = 0.01, link.inertia_z = 1;
    link.pose.translation().z() = 0.06;
    const Shape ball{ShapeKind::sphere, Eigen::Vector3d::Constant(0.16)};
    link.collisions.push_back({{}, "collision", Pose::Identity(), ball, 0.1});
    link.visuals.push_back({{}, "visual", Pose::Identity(), ball, *named_material("Gazebo/Blue")});
    model.links.push_back(std::move(link));
    return model;
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
    world->remember();
    return world;
}

bool World::build(Diagnostics& diagnostics) {
    warn_about_what_is_left_out(description_, diagnostics);
    const int errors_before = diagnostics.errors();
    if (options_.game && !description_.game) description_.game.emplace();
    plan_ = find_reset(description_, diagnostics);
    targets_ = targets_of(description_);
    for (const Model& model : description_.models)
        if (robot_link(model)) add_robot(model, diagnostics);
    add_things(diagnostics);
    if (diagnostics.errors() > errors_before) return false;

    for (const Robot& robot : robots_) bodies_.push_back(robot.body);
    std::rotate(bodies_.begin(), bodies_.begin() + static_cast<std::ptrdiff_t>(things_.size()),
                bodies_.end());
    physics_ = std::make_unique<Physics>(obstacles_of(description_, heights_), bodies_, description_.step,
                                         Physics::Contacts::when_near, heights_.meets());
    drives_.resize(bodies_.size());
    stage_.bodies.resize(bodies_.size()), stage_.present.assign(bodies_.size(), 1);
    stage_.hinges.resize(bodies_.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) stage_.hinges[i].resize(robots_[i].hinges.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) physics_->place(i, robots_[i].pose);
    for (std::size_t i = 0; i < things_.size(); ++i) physics_->place(robots_.size() + i, things_[i].start);
    add_game();
    surround();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        robot.pose = physics_->pose(i);
        robot.trials->begin(robot.pose, 0);
        robot.voice.heard.assign(robots_.size(), {});
        voices_.push_back(&robot.voice);
        by_name_.push_back(i);
    }
    std::sort(by_name_.begin(), by_name_.end(),
              [&](std::size_t a, std::size_t b) { return robots_[a].name < robots_[b].name; });
    set_stage();
    return true;
}

void World::add_robot(const Model& model, Diagnostics& diagnostics) {
    if (find(model.name))
        diagnostics.error(model.where, fmt::format("there are two robots named '{}'", model.name),
                          "give each <include> a <name> of its own");
    Robot& robot = robots_.emplace_back(model, robots_.size(), options_.seed, heights_, diagnostics);
    if (plan_ && has_plugin(model, "libreset_plugin.so"))
        robot.reset.emplace(*plan_, robot.random(Robot::reset_draws));
    robot.trials.emplace(targets_);
}

void World::add_things(Diagnostics& diagnostics) {
    std::vector<Model> loose;
    for (const Model& model : description_.models)
        if (is_loose(model)) loose.push_back(model);
    if (description_.game) {
        const auto has = std::count_if(loose.begin(), loose.end(),
                                       [](const Model& m) { return has_plugin(m, "libtarget_plugin.so"); });
        for (int i = static_cast<int>(has); i < description_.game->most; ++i) loose.push_back(resource(i));
    }
    for (const Model& model : loose) {
        things_.push_back(thing_of(model));
        bodies_.push_back(body_of(model, things_.back(), heights_));
        if (bodies_.back().radius > 0 || !bodies_.back().parts.empty()) continue;
        diagnostics.error(model.where,
                          fmt::format("'{}' has no shape that things could bump into", model.name),
                          "give it one of at most 32 different heights, or make it <static>true</static>");
    }
}

/// The homes are those of models named so; without them, where the challenge's walls have them painted.
void World::add_game() {
    std::array<Pose2, 2> homes = {Pose2{-10, 10, 0}, Pose2{10, -10, 0}};
    for (const Model& model : description_.models) {
        if (model.name == "Home_A") homes[0] = in_plane(model.pose);
        if (model.name == "Home_B") homes[1] = in_plane(model.pose);
    }
    std::vector<Game::Resource> resources;
    for (std::size_t i = 0; i < things_.size(); ++i)
        if (things_[i].resource) resources.push_back({robots_.size() + i, things_[i].start});
    game_ = Game(description_.game, homes, std::move(resources), options_.seed);
    game_.begin(*physics_);
}

/// Tells everybody what there is to see.
void World::surround() {
    std::vector<Solid> still;
    for (const Model& model : without_movers(description_).models)
        for (const Solid& solid : solids_of(model)) still.push_back(solid);
    std::vector<MovingSolid> moving;
    for (const Robot& robot : robots_) {
        moving.insert(moving.end(), robot.solids.begin(), robot.solids.end());
        sights_.insert(sights_.end(), robot.sights.begin(), robot.sights.end());
    }
    for (std::size_t i = 0; i < things_.size(); ++i) {
        const std::size_t body = robots_.size() + i;
        for (const Solid& solid : things_[i].solids) moving.push_back({body, -1, solid, false});
        for (MovingSight sight : things_[i].sights) sight.body = body, sights_.push_back(sight);
    }
    for (Robot& robot : robots_) robot.surround(still, moving);
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

/// A substep, in the original's order: the velocity plugin, the reset plugin, then the motion, then the
/// targets.
void World::advance_bodies() {
    const std::uint64_t last = substeps_before(cycle_ + 1);
    for (; substep_ < last; ++substep_) {
        for (std::size_t i = 0; i < robots_.size(); ++i) {
            drive(i);
            if (!robots_[i].hinges.empty()) robots_[i].move_gripper(*physics_, description_.step);
        }
        physics_->step(drives_);
        for (std::size_t i = 0; i < robots_.size(); ++i)
            if (!resetting(i)) robots_[i].trials->follow(physics_->pose(i));
        if (!game_.empty()) game_.substep(*physics_, time() + description_.step, description_.step);
        if (options_.native_rates) sense_when_due();
    }
    set_stage();
    ++cycle_;
}

void World::drive(std::size_t bug) {
    Robot& robot = robots_[bug];
    if (in_reset(bug)) {
        drives_[bug] = {};
        return;
    }
    drives_[bug] = robot.command;
    if (!options_.noise) return;
    std::array<double, 2> u{};
    robot.motor_random.uniform(substep_, u);
    drives_[bug].forward += (2 * u[0] - 1) * speed_noise;
    drives_[bug].turn += (2 * u[1] - 1) * speed_noise;
}

/// Where everything is now. A robot that is being reset shows up somewhere.
void World::set_stage() {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        stage_.bodies[i] = robot.pose = resetting(i) ? robot.reset->glimpse() : physics_->pose(i);
        for (std::size_t h = 0; h < robot.hinges.size(); ++h) stage_.hinges[i][h] = robot.hinges.frame(h);
    }
    for (std::size_t i = robots_.size(); i < bodies_.size(); ++i) {
        stage_.bodies[i] = physics_->pose(i);
        stage_.present[i] = physics_->present(i);
    }
    if (description_.game) colour_resources();
}

/// Good ones have their own colour, bad ones are yellow.
void World::colour_resources() {
    static const Material bad = *named_material("Gazebo/Yellow");
    for (const Game::Resource& r : game_.resources()) {
        std::size_t part = 0;
        for (MovingSight& sight : sights_) {
            if (sight.body != r.thing) continue;
            sight.visual.material =
                r.good ? things_[r.thing - robots_.size()].sights[part].visual.material : bad;
            ++part;
        }
    }
}

/// Sensors at their own rates look in the first substep in which their time has come.
void World::sense_when_due() {
    const double now = static_cast<double>(substep_ + 1) * description_.step;
    bool staged = false;
    const auto due = [&](double period, std::uint64_t done) {  // period 0: in every substep
        if (now < static_cast<double>(done) * period - 1e-9) return false;
        if (!staged) set_stage();
        return staged = true;
    };
    for (Robot& robot : robots_) {
        if (due(robot.proximity ? robot.proximity->period : description_.step, robot.scans))
            robot.sense(options_.noise, robot.scans++, stage_);
        if (robot.wants_image &&
            due(robot.camera_sensor && robot.camera_sensor->rate > 0 ? 1 / robot.camera_sensor->rate : 0,
                robot.pictures))
            robot.render(options_.noise, robot.pictures++, stage_, sights_);
    }
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
    if (!options_.native_rates || cycle_ == 0)
        for (Robot& robot : robots_) robot.sense(options_.noise, cycle_, stage_);
    if (options_.native_rates && cycle_ == 0)
        for (Robot& robot : robots_) robot.scans = 1;
    hear();
}

/// What was said in the cycle that ends is heard now.
void World::hear() {
    bool said = false;
    for (const Robot& robot : robots_) said |= robot.voice.speaking;
    if (!said) return;
    deliver(voices_, stage_.bodies, by_name_);
    for (Robot& robot : robots_) robot.snapshot.heard = sum(robot.voice, by_name_);
}

void World::render() {
    if (!options_.native_rates)
        for (Robot& robot : robots_)
            if (robot.wants_image) robot.render(options_.noise, cycle_, stage_, sights_);
    remember();
}

void World::remember() {
    if (options_.late <= 0) return;
    const auto size = static_cast<std::size_t>(options_.late) + 1;
    for (Robot& robot : robots_) {
        if (cycle_ == 0)
            robot.history.assign(size, robot.snapshot);
        else
            robot.history[cycle_ % size] = robot.snapshot;
    }
}

const BugSnapshot& World::snapshot(std::size_t bug) const {
    const Robot& robot = robots_[bug];
    return robot.history.empty() ? robot.snapshot : robot.history[(cycle_ + 1) % robot.history.size()];
}

void World::checkpoint(Archive& archive) {
    archive.same(robots_.size(), "the number of robots");
    archive(cycle_, substep_);
    for (Robot& robot : robots_) robot.checkpoint(archive);
    archive(stage_, game_, *physics_);
    if (archive.loading() && description_.game) colour_resources();
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

std::shared_ptr<const Scene> World::scene() {
    if (!scene_) scene_ = std::make_shared<const Scene>(without_movers(description_));
    return scene_;
}

void World::make_camera(std::size_t bug) {
    if (robots_[bug].camera_sensor && !robots_[bug].camera) robots_[bug].make_camera(scene());
}

std::span<const std::uint8_t> World::image(std::size_t bug) {
    make_camera(bug);
    Robot& robot = robots_[bug];
    if (!options_.native_rates || robot.pictures == 0) {
        robot.render(options_.noise, options_.native_rates ? 0 : cycle_, stage_, sights_);
        if (options_.native_rates) robot.pictures = 1;
    }
    return snapshot(bug).image;
}

void World::need_image(std::size_t bug, bool needed) {
    robots_[bug].wants_image = needed;
    if (needed) image(bug);
    if (cycle_ == 0) remember();
}

void World::need_gripper_scan(std::size_t bug, bool needed) {
    robots_[bug].wants_gripper_scan = needed;
    if (needed && cycle_ == 0) robots_[bug].sense(options_.noise, 0, stage_);
    if (cycle_ == 0) remember();
}

std::vector<DrawnSolid> World::drawing() const {
    auto out = drawing_of(description_);
    for (const MovingSight& sight : sights_) {
        if (sight.body < robots_.size() || !stage_.present[sight.body]) continue;
        Solid solid = sight.visual.solid;
        solid.pose = sight.at(stage_);
        out.push_back({solid, sight.visual.material.diffuse});
    }
    return out;
}

std::optional<Pose2> World::thing_pose(std::size_t i) const {
    const std::size_t body = robots_.size() + i;
    if (!stage_.present[body]) return {};
    return stage_.bodies[body];
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
