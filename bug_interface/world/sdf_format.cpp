#include "bug_interface/world/sdf_format.h"

#include "core/xml/document.h"

namespace forage::bug {
namespace {

using xml::ValueKind;
using Values = std::map<std::string, xml::ValueRule, std::less<>>;

constexpr double any = std::numeric_limits<double>::infinity();
constexpr double smallest = 1e-12;  // lower limit of values that must be above 0
constexpr double largest = 1e4;     // m; contacts are found in single precision

xml::ValueRule number(std::string doc, double low = -any, double high = any, std::size_t count = 1) {
    return {.kind = ValueKind::number,
            .doc = std::move(doc),
            .low = low,
            .high = high,
            .least = count,
            .most = count};
}
xml::ValueRule numbers(std::size_t count, std::string doc, double low = -any, double high = any) {
    return number(std::move(doc), low, high, count);
}
xml::ValueRule whole(std::string doc, double low = -any, double high = any) {
    return {.kind = ValueKind::whole, .doc = std::move(doc), .low = low, .high = high};
}
xml::ValueRule choice(std::string doc, std::vector<std::string> choices) {
    return {.kind = ValueKind::choice, .doc = std::move(doc), .choices = std::move(choices)};
}

Values values() {
    Values out = {
        {"s", {}},
        {"*", {.kind = ValueKind::any}},
        {"b", {.kind = ValueKind::boolean, .doc = "true or false"}},
        {"1", number("a number, with a point and without a unit")},
        {"i", whole("a whole number")},
        {"2", numbers(2, "two numbers with a blank between them")},
        {"3", numbers(3, "three numbers with blanks between them")},
        {"c", numbers(4, "red green blue alpha", 0, 1)},
        {"p", numbers(6, "six numbers x y z roll pitch yaw, in m and rad")},
        {"quaternion", numbers(7, "seven numbers x y z qx qy qz qw")},
        {"length", number("in m", 0, largest)},
        {"radius", number("in m", 0, largest / 2)},
        {"size2", numbers(2, "two numbers x y, in m", 0, largest)},
        {"size3", numbers(3, "three numbers x y z, in m", 0, largest)},
        {"mass", number("in kg", smallest, 1e6)},
        {"inertia", number("in kg m2", smallest, 1e6)},
        {"friction", number("0 is ice, 1 holds well", 0)},
        {"deviation", number("a standard deviation, in m for a ray sensor; 0 for no noise", 0)},
        {"rate", number("how often the sensor looks in a second of the world; 0 for in every cycle", 0)},
        {"step", number("in s, usually 0.001", 1e-6, 1)},
        {"steps", number("in a second, usually 1000", 1e-6, 1e6)},
        {"rays", whole("how many rays", 1, 10'000)},
        {"pixels", whole("in pixels", 1, 4096)},
        {"fov", number("the opening angle, in rad", 1e-3, 3.1)},
        {"link", {.doc = "the name of a link"}},
        {"uri", {.doc = "what is included, model://NAME"}},
        {"joint", choice("how it moves", {"revolute", "revolute2", "prismatic", "ball", "screw", "universal",
                                          "fixed", "gearbox", "continuous", "piston"})},
        {"version", choice("of the format, such as 1.4",
                           {"1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"})},
    };
    out["c"].least = 3;  // alpha may be left out
    out["p"].may_be_empty = true;
    out["p"].exception = {"rotation_format", "quat_xyzw", "quaternion"};
    return out;
}

/// An element, its content (ElementRule::content), and its required attributes. Kinds of values are s for
/// text, b for true or false, 1 for a number, i for a whole number, 2 and 3 for as many numbers, c for a
/// colour, p for a pose, and * for anything, which has no effect and is not checked. Other kinds have their
/// own line in values().
struct Row {
    std::string_view element, content, attributes = {};
    int choose = 0;
};

constexpr Row rows[] = {
    {"sdf", "actor:* light model world?", "version:version"},
    {"world",
     "actor:* atmosphere:* audio:* frame:* gravity:3 gui:* include light magnetic_field:3 model physics "
     "plugin population:* road:* scene spherical_coordinates:* state:* wind:*",
     "name"},
    {"physics",
     "bullet:* dart:* gravity:3 magnetic_field:3 max_contacts:i max_step_size:step ode provide_feedback:b "
     "real_time_factor:1 real_time_update_rate:steps simbody:* update_rate:steps",
     "type"},
    {"ode", "constraints:* fdir1:3 mu:friction mu2:1 slip:1 slip1:1 slip2:1 solver"},
    {"solver",
     "dt:step friction_model:s island_threads:i iters:i min_step_size:1 precon_iters:i solver_type:s sor:1 "
     "thread_position_correction:b type:s use_dynamic_moi_rescaling:b"},
    {"scene", "ambient:c background:c fog:* grid:b origin_visual:b shadows:b sky:*"},
    {"light",
     "attenuation:* cast_shadows:b diffuse:c direction:3 frame:* intensity:1 pose:p specular:c spot:*",
     "name type"},
    {"plugin", ":*", "name filename"},
    {"include", "name:s placement_frame:s plugin pose:p static:b uri+:uri"},
    {"model",
     "allow_auto_disable:b enable_wind:b frame:* gripper:* include joint link model plugin pose:p "
     "self_collide:b static:b",
     "name"},
    {"link",
     "audio_sink:* audio_source:* battery:* collision enable_wind:b frame:* gravity:b inertial kinematic:b "
     "light must_be_base_link:b particle_emitter:* pose:p projector:* self_collide:b sensor velocity_decay:* "
     "visual",
     "name"},
    {"inertial", "frame:* inertia mass:mass pose:p"},
    {"inertia", "ixx:1 ixy:1 ixz:1 iyy:1 iyz:1 izz:inertia"},
    {"collision", "frame:* geometry! laser_retro:1 max_contacts:i pose:p surface", "name"},
    {"surface", "bounce:* contact:* friction soft_contact:*"},
    {"friction", "bullet:* ode torsional:*"},
    {"visual",
     "cast_shadows:b frame:* geometry! laser_retro:1 material meta:* plugin pose:p transparency:1 "
     "visibility_flags:i",
     "name"},
    {"geometry", "plane box cylinder sphere", "", 1},
    {"box", "size+:size3"},
    {"cylinder", "length+:length radius+:radius"},
    {"plane", "normal:3 size:size2"},
    {"sphere", "radius+:radius"},
    {"material",
     "ambient:c diffuse:c double_sided:b emissive:c lighting:b pbr:* render_order:1 script shader:* "
     "specular:c"},
    {"script", "name:s uri:s"},
    {"joint",
     "axis axis2:* child+:link frame:* gearbox_ratio:1 gearbox_reference_body:s parent+:link physics:* "
     "pose:p sensor thread_pitch:1",
     "name type:joint"},
    {"axis", "dynamics:* initial_position:1 limit use_parent_model_frame:b xyz:3"},
    {"limit", "cfm:1 dissipation:1 effort:1 erp:1 lower:1 stiffness:1 upper:1 velocity:1"},
    {"sensor",
     "air_pressure:* altimeter:* always_on:b camera contact:* enable_metrics:b force_torque:* frame:* gps:* "
     "imu:* lidar:* logical_camera:* magnetometer:* navsat:* plugin pose:p ray rfid:* rfidtag:* sonar:* "
     "topic:s transceiver:* update_rate:rate visualize:b",
     "name type"},
    {"ray", "noise range scan"},
    {"scan", "horizontal vertical"},
    {"horizontal", "max_angle:1 min_angle:1 noise:* resolution:1 samples:rays"},
    {"vertical", "max_angle:1 min_angle:1 noise:* resolution:1 samples:i"},
    {"range", "max:1 min:1 resolution:1"},
    {"noise",
     "bias_mean:1 bias_stddev:1 dynamic_bias_correlation_time:1 dynamic_bias_stddev:1 mean:1 precision:1 "
     "stddev:deviation type:s"},
    {"camera",
     "box_type:s clip depth_camera:* distortion:* frame:* horizontal_fov:fov image lens:* noise pose:p "
     "projection_type:s save:* segmentation_type:s visibility_mask:i"},
    {"image", "format:s height:pixels width:pixels"},
    {"clip", "far:1 near:1"},
};

xml::Format make_format() {
    xml::Format out{.name = "a world or model file",
                    .beginning = "<sdf version=\"1.4\">",
                    .roots = {"sdf", "gazebo"},  // the name until version 1.2
                    .max_nodes = 10'000,         // all worlds that ship have fewer
                    .open = true,
                    .values = values()};
    for (const Row& row : rows) {
        xml::ElementRule& e = out.elements.emplace_back();
        e.name = row.element, e.content = row.content, e.choose = row.choose;
        for (const std::string_view word : xml::words(row.attributes)) {
            const auto name = word.substr(0, word.find(':'));
            const auto kind = name.size() < word.size() ? word.substr(name.size() + 1) : "s";
            e.attributes.push_back({std::string(name), out.values.find(kind)->second, true});
        }
    }
    return std::move(out).link();
}

}  // namespace

const xml::Format& sdf_format() {
    static const xml::Format format = make_format();
    return format;
}

const xml::Format& model_config_format() {
    static const xml::Format format{
        .name = "a model's description", .beginning = "<model>", .roots = {"model"}, .max_nodes = 1000};
    return format;
}

}  // namespace forage::bug
