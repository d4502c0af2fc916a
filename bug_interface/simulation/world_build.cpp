#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/sensing/solid_ray.h"
#include "bug_interface/simulation/checks.h"
#include "bug_interface/simulation/world.h"
#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

/// A resource of the challenge: a blue ball.
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

/// The highest point of the robots and their ray sensors, m; 0 without robots.
double highest_point(const std::vector<Robot>& robots) {
    double top = 0;
    for (const Robot& robot : robots) {
        for (const MovingSolid& s : robot.solids)
            top = std::max(top, s.solid.pose.translation().z() + s.solid.size.z() / 2);
        for (const RangeSensor& s : robot.sensors.range_sensors())
            top = std::max(top, (robot.sensors.link_pose() * s.pose).translation().z());
    }
    return top;
}

}  // namespace

World::World(std::shared_ptr<const WorldDescription> description, const WorldOptions& options)
    : shared_description_(std::move(description)),
      description_(*shared_description_),
      options_(options),
      surroundings_(options.surroundings ? options.surroundings
                                         : std::make_shared<Surroundings>(description_)) {
    const double factor = options.real_time_factor.value_or(description_.step * description_.update_rate);
    constexpr double max_substeps = 1e18;  // of a system that model::validate() refuses
    substeps_per_cycle_ = std::min(factor / (options.cycles_per_second * description_.step), max_substeps);
}

std::unique_ptr<World> World::make(const WorldDescription& description, const WorldOptions& options,
                                   Diagnostics& diagnostics) {
    const int errors_before = diagnostics.errors();
    const double factor = options.real_time_factor.value_or(1);
    if (!(options.cycles_per_second > 0) || !(factor > 0 && factor <= 1e9)) {
        diagnostics.error(
            {},
            "a simulated world needs a number of cycles per second and a real time factor above 0, at most "
            "1e9",
            "give the system's cyclesPerSecond, or choose one on the command line");
        return nullptr;
    }
    check_models(description, diagnostics);
    if (diagnostics.errors() > errors_before) return nullptr;
    auto own = std::make_shared<WorldDescription>(description);
    if (options.game && !own->game) own->game.emplace();
    std::unique_ptr<World> world(new World(std::move(own), options));
    if (!world->build(diagnostics)) return nullptr;
    world->scan();
    world->remember();
    return world;
}

std::unique_ptr<Environment> World::restarted(std::uint64_t seed) const {
    WorldOptions options = options_;
    options.seed = seed, options.surroundings = surroundings_;
    std::unique_ptr<World> world(new World(shared_description_, options));
    Diagnostics reported;  // by make()
    world->build(reported);
    world->scan();
    world->remember();
    return world;
}

/// Returns false when `diagnostics` got an error.
bool World::build(Diagnostics& diagnostics) {
    const int errors_before = diagnostics.errors();
    plan_ = find_reset(description_, diagnostics);
    targets_ = targets_of(description_);
    for (const Model& model : description_.models)
        if (robot_link(model)) add_robot(model, diagnostics);
    add_movable_objects(diagnostics);
    if (diagnostics.errors() > errors_before) return false;
    check_places(description_, plan_, highest_point(robots_), diagnostics);

    for (const Robot& robot : robots_) bodies_.push_back(robot.body);
    std::rotate(bodies_.begin(), bodies_.begin() + static_cast<std::ptrdiff_t>(movable_objects_.size()),
                bodies_.end());
    physics_ = std::make_unique<Physics>(obstacles_of(description_, heights_), bodies_, description_.step,
                                         options_.stepping, heights_.collision_masks());
    drives_.resize(bodies_.size()), reach_.resize(bodies_.size());
    driven_.assign(robots_.size(), 1);
    body_poses_.bodies.resize(bodies_.size()), body_poses_.present.assign(bodies_.size(), 1);
    body_poses_.hinges.resize(bodies_.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) body_poses_.hinges[i].resize(robots_[i].hinges.size());
    place_bodies(diagnostics);
    add_game();
    add_sensors();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        Robot& robot = robots_[i];
        robot.pose = physics_->pose(i);
        robot.trials->begin(robot.pose, 0);
        robot.transceiver.received.assign(robots_.size(), {});
        transceivers_.push_back(&robot.transceiver);
        by_name_.push_back(i);
    }
    std::ranges::sort(by_name_,
                      [&](std::size_t a, std::size_t b) { return robots_[a].name < robots_[b].name; });
    update_body_poses();
    return true;
}

/// Places all bodies at their start poses. Warns about bodies that overlap others and about occupied sites.
void World::place_bodies(Diagnostics& diagnostics) {
    const auto warn = [&](const std::string& name, std::string_view what) {
        if (const Model* model = find_model(description_, name))
            diagnostics.warning(
                model->where, fmt::format("{}'{}' starts inside another object and may be stuck", what, name),
                "change its <pose>");
    };
    if (description_.game && !movable_objects_.empty())
        for (const GameSite& site : description_.game->sites)
            if (!physics_->is_collision_free(robots_.size(), {site.x, site.y, 0}))
                diagnostics.warning(site.where,
                                    fmt::format("the site ({:g}, {:g}) is occupied", site.x, site.y),
                                    "resources appear at free positions within 0.5 m");
    for (std::size_t i = 0; i < robots_.size(); ++i) physics_->place(i, robots_[i].pose);
    for (std::size_t i = 0; i < robots_.size(); ++i)
        if (!physics_->is_collision_free(i, physics_->pose(i))) warn(robots_[i].name, "robot ");
    for (std::size_t i = 0; i < movable_objects_.size(); ++i)  // objects may overlap each other
        if (!(description_.game && movable_objects_[i].resource) &&
            !physics_->is_collision_free(robots_.size() + i, movable_objects_[i].start))
            warn(movable_objects_[i].name, "");
    for (std::size_t i = 0; i < movable_objects_.size(); ++i)
        physics_->place(robots_.size() + i, movable_objects_[i].start);
}

void World::add_robot(const Model& model, Diagnostics& diagnostics) {
    if (find(model.name))
        diagnostics.error(model.where, fmt::format("there are two robots named '{}'", model.name),
                          "give each <include> a <name> of its own");
    Robot& robot =
        robots_.emplace_back(model, robots_.size(), options_.seed, options_.noise, heights_, diagnostics);
    if (plan_ && has_plugin(model, "libreset_plugin.so"))
        robot.reset.emplace(*plan_, robot_stream(options_.seed, robot.name, RobotStream::reset_draws));
    robot.trials.emplace(targets_, rules().reach);
}

void World::add_movable_objects(Diagnostics& diagnostics) {
    std::vector<Model> movable;
    for (const Model& model : description_.models)
        if (is_movable(model)) movable.push_back(model);
    if (description_.game) {
        const auto has = std::ranges::count_if(
            movable, [](const Model& m) { return has_plugin(m, "libtarget_plugin.so"); });
        for (int i = static_cast<int>(has); i < description_.game->most; ++i) movable.push_back(resource(i));
    }
    for (const Model& model : movable) {
        movable_objects_.push_back(movable_object_of(model));
        bodies_.push_back(body_of(model, movable_objects_.back(), heights_, diagnostics));
        if (bodies_.back().radius > 0 || !bodies_.back().parts.empty()) continue;
        diagnostics.error(model.where, fmt::format("'{}' has no shape that can be touched", model.name),
                          "give it a <collision>, or make it <static>true</static>");
    }
}

/// The homes are the models Home_A and Home_B. Without them, they are where the challenge's walls show them.
void World::add_game() {
    std::array<Pose2, 2> homes = {Pose2{-10, 10, 0}, Pose2{10, -10, 0}};
    for (const Model& model : description_.models) {
        if (model.name == "Home_A") homes[0] = in_plane(model.pose);
        if (model.name == "Home_B") homes[1] = in_plane(model.pose);
    }
    std::vector<Game::Resource> resources;
    for (std::size_t i = 0; i < movable_objects_.size(); ++i)
        if (movable_objects_[i].resource)
            resources.push_back({robots_.size() + i, movable_objects_[i].start});
    game_ = Game(description_.game, homes, std::move(resources), options_.seed);
    game_.begin(*physics_);
}

/// Collects the solids and visuals that sensors can see, and makes the scanners.
void World::add_sensors() {
    std::vector<Solid> fixed;
    for (const Model& model : static_part(description_).models)
        for (const Solid& solid : solids_of(model)) fixed.push_back(solid);
    std::vector<MovingSolid> moving;
    for (const Robot& robot : robots_) {
        moving.insert(moving.end(), robot.solids.begin(), robot.solids.end());
        for (const MovingVisual& visual : robot.visuals) moving_visuals_.add(visual);
    }
    for (std::size_t i = 0; i < movable_objects_.size(); ++i) {
        const std::size_t body = robots_.size() + i;
        for (const Solid& solid : movable_objects_[i].solids) moving.push_back({body, -1, solid, false});
        for (MovingVisual visual : movable_objects_[i].visuals)
            visual.body = body, moving_visuals_.add(visual);
    }
    body_poses_.radius.assign(bodies_.size(), 0);
    const auto extend = [&](std::size_t body, const Pose& pose, const Solid& solid) {
        double& radius = body_poses_.radius[body];
        radius = std::max(radius, pose.translation().head<2>().norm() + std::sqrt(radius_squared(solid)));
    };
    for (const MovingSolid& m : moving) extend(m.body, m.solid.pose, m.solid);
    for (const MovingVisual& v : moving_visuals_) extend(v.body, v.pose, v.visual.solid);
    for (Robot& robot : robots_) robot.sensors.make_scanners(fixed, moving, description_.step);
}

}  // namespace forage::bug
