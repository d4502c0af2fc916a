#include "bug_interface/world/sdf_format.h"

#include <algorithm>

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
        {"actor",
         {.kind = ValueKind::any,
          .doc =
              "what moves is a robot, which a system drives, or a model without <static> that robots push"}},
        {"road", {.kind = ValueKind::any, .doc = "draw it into the picture of the floor"}},
        {"shape",
         {.kind = ValueKind::any,
          .doc = "this visual is not drawn: shapes are <box>, <cylinder>, <sphere> and <plane>"}},
        {"rotation", choice("how the rotation is written", {"euler_rpy", "quat_xyzw"})},
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

/// An element, its content (ElementRule::content), and its attributes, of which those with ? are optional.
/// Kinds of values are s for text, b for true or false, 1 for a number, i for a whole number, 2 and 3 for as
/// many numbers, c for a colour, p for a pose, and * for elements that are not checked. Other kinds have
/// their own line in values(). What has = is not read (ChildRule::inert). With =* are only elements that
/// concern windows, solvers or measuring instruments of other simulators, or directions in which nothing
/// moves here.
struct Row {
    std::string_view element, content, attributes = {};
    int choose = 0;
};

constexpr Row rows[] = {
    {"sdf", "actor&:actor= light& model& world?", "version:version"},
    {"world",
     "actor&:actor= atmosphere:*=* audio:*=* frame& gravity:3=0,0,-9.8 gui:*=* include& light& "
     "magnetic_field:3=* model& physics plugin& population&:*= road&:road= scene spherical_coordinates:*=* "
     "state wind:*=",
     "name"},
    {"state",
     "deletions:*= insertions:*= iterations:*=* light&@state_light model&@state_model real_time:*=* "
     "sim_time:*=* wall_time:*=*",
     "world_name?=*"},
    {"state_light", "pose@pose:p", "name"},
    {"state_model", "joint&:*= link&@state_link model&@state_model pose@pose:p scale:3=1,1,1", "name"},
    {"state_link", "acceleration:*=* collision&:*=* pose@pose:p velocity:p=* wrench:*=*", "name"},
    {"frame", "pose@pose:p", "name attached_to?"},
    {"pose", "", "degrees?:b frame? relative_to? rotation_format?:rotation"},
    {"physics",
     "bullet:*=* dart:*=* gravity:3=0,0,-9.8 magnetic_field:3=* max_contacts:i=* max_step_size:step "
     "ode@solvers provide_feedback:b=* real_time_factor:1=1|0 real_time_update_rate:steps simbody:*=* "
     "update_rate:steps",
     "type default?=* name?=*"},
    {"solvers", "constraints:*=* solver"},
    {"solver",
     "dt:step friction_model:s=* island_threads:i=* iters:i=* min_step_size:1=* precon_iters:i=* "
     "solver_type:s=* sor:1=* thread_position_correction:b=* type:s=* use_dynamic_moi_rescaling:b=*"},
    {"scene", "ambient:c background:c=0.7,0.7,0.7 fog:*= grid:b=* origin_visual:b=* shadows:b=* sky:*="},
    {"light",
     "attenuation:*=* cast_shadows:b=* diffuse:c=1,1,1|0.8,0.8,0.8 direction:3 frame&:*= intensity:1=1 "
     "light_on:b=1 pose@pose:p specular:c=* spot:*=* visualize:b=*",
     "name type"},
    {"plugin", ":*", "name filename"},
    {"include", "name:s placement_frame:s plugin& pose@pose:p static:b uri+:uri", "merge?:b"},
    {"model",
     "allow_auto_disable:b=* enable_wind:b=0 frame& gripper&:*= include& joint& link& model& plugin& "
     "pose@pose:p self_collide:b=0 static:b",
     "name canonical_link?=* placement_frame?="},
    {"link",
     "audio_sink&:*=* audio_source&:*=* battery&:*= collision& enable_wind:b=0 frame&:*= gravity:b=1 "
     "inertial kinematic:b=0 light&:*= must_be_base_link:b=* particle_emitter&:*= pose@pose:p projector&:*= "
     "self_collide:b=0 sensor& velocity_decay:*= visual&",
     "name"},
    {"inertial", "density:1= frame&:*= inertia mass:mass pose@pose:p=0,0,0,0,0,0"},
    {"inertia", "ixx:1=* ixy:1=* ixz:1=* iyy:1=* iyz:1=* izz:inertia"},
    {"collision", "density:1= frame&:*= geometry! laser_retro:1=0 max_contacts:i=* pose@pose:p surface",
     "name"},
    {"surface", "bounce contact friction soft_contact:*=*"},
    {"bounce", "restitution_coefficient:1=0 threshold:1=*"},
    {"contact",
     "bullet:*=* category_bitmask:s=* collide_bitmask:s=65535|255|0xffff|0xff collide_without_contact:b=0 "
     "collide_without_contact_bitmask:s=* elastic_modulus:1=* ode:*=* poissons_ratio:1=*"},
    {"friction", "bullet:*= ode torsional:*=*"},
    {"ode", "fdir1:3=0,0,0 mu:friction mu2:1=* slip:1=0 slip1:1=0 slip2:1=0"},
    {"visual",
     "cast_shadows:b=* frame&:*= geometry!@visible laser_retro:1=0 material meta:*=* plugin&:*= pose@pose:p "
     "transparency:1=0 visibility_flags:i=*",
     "name"},
    {"geometry", "plane box cylinder sphere", "", 1},
    {"visible",
     "plane box cylinder sphere capsule:shape= cone:shape= ellipsoid:shape= empty:*=* heightmap:shape= "
     "image:shape= mesh:shape= polyline&:shape=",
     "", 1},
    {"box", "size+:size3"},
    {"cylinder", "length+:length radius+:radius"},
    {"plane", "normal:3=0,0,1 size:size2"},
    {"sphere", "radius+:radius"},
    {"material",
     "ambient:c diffuse:c double_sided:b=* emissive:c=0,0,0 lighting:b=1 pbr:*= render_order:1=* script "
     "shader:*= shininess:1=* specular:c=0,0,0"},
    {"script", "name:s uri&:s"},
    {"joint",
     "axis axis2:*= child+:link frame&:*= gearbox_ratio:1= gearbox_reference_body:s= parent+:link "
     "physics:*=* pose@pose:p sensor&:*= thread_pitch:1=",
     "name type:joint"},
    {"axis", "dynamics:*= initial_position:1=0 limit use_parent_model_frame:b=* xyz@xyz:3"},
    {"xyz", "", "expressed_in?=__model__"},
    {"limit", "cfm:1=* dissipation:1=* effort:1=-1 erp:1=* lower:1 stiffness:1=* upper:1 velocity:1=-1"},
    {"sensor",
     "air_pressure:*=* altimeter:*=* always_on:b=* camera contact:*=* enable_metrics:b=* force_torque:*=* "
     "frame&:*= gps:*=* imu:*=* lidar:*=* logical_camera:*=* magnetometer:*=* navsat:*=* plugin&:*= "
     "pose@pose:p ray rfid:*=* rfidtag:*=* sonar:*=* topic:s=* transceiver:*=* update_rate:rate "
     "visualize:b=*",
     "name type"},
    {"ray", "noise range scan"},
    {"scan", "horizontal vertical"},
    {"horizontal", "max_angle:1 min_angle:1 noise:*= resolution:1=1 samples:rays"},
    {"vertical", "max_angle:1=0 min_angle:1=0 noise:*= resolution:1=* samples:i=1"},
    {"range", "max:1 min:1 resolution:1=*"},
    {"noise",
     "bias_mean:1=0 bias_stddev:1=0 dynamic_bias_correlation_time:1=0 dynamic_bias_stddev:1=0 mean:1=0 "
     "precision:1=0 stddev:deviation type:s=gaussian|none",
     "type?=gaussian|none"},
    {"camera",
     "box_type:s= clip depth_camera:*= distortion:*= frame&:*= horizontal_fov:fov image lens:*= noise "
     "pose@pose:p=0,0,0,0,0,0 projection_type:s= save:*=* segmentation_type:s= visibility_mask:i=*",
     "name?=*"},
    {"image", "format:s=R8G8B8|RGB_INT8 height:pixels width:pixels"},
    {"clip", "far:1 near:1=*"},
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
            auto rest = word.substr(0, word.find('='));
            const auto colon = std::min(rest.find(':'), rest.size());
            const auto kind = colon < rest.size() ? rest.substr(colon + 1) : "s";
            auto name = rest.substr(0, colon);
            const bool required = !name.ends_with('?');
            if (!required) name.remove_suffix(1);
            xml::AttributeRule rule{std::string(name), out.values.find(kind)->second, required};
            if (rest.size() < word.size()) rule.inert = word.substr(rest.size() + 1);
            e.attributes.push_back(std::move(rule));
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
