// The content of a world file: plain values without behaviour, with their locations in the file.
//
// In the world frame, x is to the right (east) and y is up (north) on every map, and z points upwards. Units
// are metres, radians, seconds and kilograms.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/archive.h"
#include "core/base/diagnostic.h"
#include "core/run/trial.h"

namespace forage::bug {

using forage::Pose2;

/// A pose in the frame of the parent: of a model in the world, of a link in its model, of other things in
/// their link.
using Pose = Eigen::Isometry3d;
using Colour = Eigen::Array3f;  ///< red, green, blue in 0..1

enum class ShapeKind { plane, box, cylinder, sphere };

struct Shape {
    ShapeKind kind = ShapeKind::box;
    /// Full extents along the axes, which are diameters where the shape is round. The z of a plane is unused.
    Eigen::Vector3d size = Eigen::Vector3d::Zero();
};

/// How a surface reflects light: shade = ambient * scene ambient + diffuse * max(0, normal . light).
struct Material {
    Colour ambient = Colour::Constant(0.3f);  ///< the default is plain grey
    Colour diffuse = Colour::Constant(0.7f);
    std::string texture;  ///< path of a PNG image, or empty
};

struct Collision {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    Shape shape;
    double friction = 1;  ///< Coulomb coefficient
};

struct Visual {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    Shape shape;
    Material material;
};

/// What a range sensor is for, which its name says.
enum class RangePurpose { proximity, light, gripper, none };

/// A purpose, the name of its sensor, the output port of a robot's module that gets the scan, and its title
/// in pictures.
struct RangeUse {
    RangePurpose purpose;
    std::string_view sensor, port, title;
};
inline constexpr std::array<RangeUse, 3> range_uses = {
    {{RangePurpose::proximity, "laser", "_proximity", "proximity"},
     {RangePurpose::light, "laser_target", "_target", "light"},
     {RangePurpose::gripper, "laser_gripper", "_proximityGripper", "gripper"}}};

/// A planar range scanner. Ray i of n points `first + i * (last - first) / (n - 1)` to the left of the
/// sensor's x axis.
struct RangeSensor {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    int rays = 1;
    double first_angle = 0, last_angle = 0;  ///< rad
    double min_range = 0, max_range = 1;     ///< m; nearer surfaces are invisible
    double noise = 0;                        ///< standard deviation, m
    double rate = 0;  ///< scans per second of the world; 0 for a scan whenever it is requested

    /// What is known of its purpose; null when groups cannot get its scan.
    const RangeUse* use() const {
        for (const auto& known : range_uses)
            if (known.sensor == name) return &known;
        return nullptr;
    }
    RangePurpose purpose() const { return use() ? use()->purpose : RangePurpose::none; }
    /// The angle of the ray behind a cell of the scan's group, rad to the left; cell 0 is the last ray.
    double cell_angle(int cell) const {
        return rays > 1 ? last_angle - cell * (last_angle - first_angle) / (rays - 1) : first_angle;
    }
};

/// A pinhole camera that looks along its x axis.
struct CameraSensor {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    double horizontal_fov = 1;    ///< full opening angle, rad
    int width = 32, height = 28;  ///< pixels
    double far = 20;              ///< distance beyond which nothing is drawn, m
    double noise = 0;             ///< standard deviation of a channel in 0..1
    double rate = 0;  ///< pictures per second of the world; 0 for a picture whenever it is requested
};

struct Link {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    double mass = 1;
    double inertia_z = 1;  ///< kg m^2
    std::vector<Collision> collisions;
    std::vector<Visual> visuals;
    std::vector<RangeSensor> range_sensors;
    std::vector<CameraSensor> cameras;
};

struct Plugin {
    Location where;
    std::string name, filename;
};

/// A vertical hinge between two links. Its angle is 0 where the model's file puts the links.
struct Hinge {
    Location where;
    std::string name;
    std::string parent, child;     ///< names of links; "MODEL::LINK" for a link of a model in this one
    Pose pose = Pose::Identity();  ///< pose of the axis in the child link
    double sense = 1;              ///< 1 when the child turns to the left as the angle grows, else -1
    double lower = 0, upper = 0;   ///< limits of the angle, rad
};

struct Model {
    Location where;
    std::string name;
    Pose pose = Pose::Identity();
    bool is_static = false;
    std::vector<Link> links;
    std::vector<Plugin> plugins;
    std::vector<Hinge> hinges;
    std::vector<Model> models;  ///< models that are fixed to this one
};

/// A place where resources of a game appear.
struct GameSite {
    double x = 0, y = 0;  ///< m
    double chance = 0;    ///< probability that a resource appears in a second, 0..1
    Location where = {};
};

/// The rules of a game of two teams that collect resources. The defaults are those of the robotics challenge.
struct GameRules {
    Location where;
    double duration = 300;        ///< s
    double stale_after = 30;      ///< age at which a resource that is not held turns bad (yellow), s
    double dissolves_after = 50;  ///< age at which it is removed, s
    int points = 2;               ///< points for a good resource at a home
    int penalty = -1;             ///< points for a bad resource
    int most = 16;                ///< largest number of resources at a time
    std::vector<GameSite> sites;  ///< when empty, they are drawn from the challenge's table
};

/// When trials end, besides leaving the bounds, and how they begin.
struct TrialRules {
    Location where;
    double reach = 0.45;    ///< distance between the centres of robot and target that ends a trial, m
    double duration = 1e9;  ///< longest trial, s
    double heading = 0.01;  ///< largest deviation of a start's heading from that of its model, rad
};

/// Everything in a world file that Forage uses.
struct WorldDescription {
    std::string path;
    std::set<std::string> files;  ///< what it includes: models, their configurations, scripts, pictures
    double step = 0.001;          ///< physics step, s
    double update_rate = 1000;    ///< physics steps per second of wall-clock time, as given in the file
    float ambient = 0.4f;         ///< ambient light, 0..1
    std::optional<Eigen::Vector3d> sun;  ///< unit vector towards a directional light
    std::vector<Model> models;
    std::optional<GameRules> game;     ///< the rules in the plugin libforage_game.so
    std::optional<TrialRules> trials;  ///< the rules in the plugin libforage_trials.so
};

/// The first model named `name`, or null.
inline const Model* find_model(const WorldDescription& world, std::string_view name) {
    for (const Model& model : world.models)
        if (model.name == name) return &model;
    return nullptr;
}

/// The yaw angle of a pose, rad.
inline double yaw_of(const Pose& pose) { return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)); }
/// The projection of a pose onto the floor.
inline Pose2 in_plane(const Pose& pose) {
    return {pose.translation().x(), pose.translation().y(), yaw_of(pose)};
}

}  // namespace forage::bug
