// Links and the joints between them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {

Link read_link(SdfSource& in, const xml::Element& e) {
    Link link;
    link.where = e.where, link.name = name_of(e), link.pose = in.pose_of(e);
    if (const auto* inertial = e.child("inertial")) {
        link.mass = in.value(*inertial, "mass", 1.0);
        link.inertia_z = in.value(*inertial, "inertia/izz", 1.0);
        if (!(link.mass > 0 && link.inertia_z > 0))
            in.diagnostics.error(inertial->where, "mass and inertia must be positive",
                                 "they are in kg and kg m2");
        constexpr double heaviest = 1e6;
        if (link.mass > heaviest || link.inertia_z > heaviest)
            in.diagnostics.error(inertial->where, fmt::format("mass or inertia is more than {:g}", heaviest),
                                 "they are in kg and kg m2");
    }
    each(e, "collision", [&](const xml::Element& c) {
        const double friction = in.value(c, "surface/friction/ode/mu", 1.0);
        if (friction < 0)
            in.diagnostics.error(c.child("surface/friction/ode/mu")->where,
                                 "a friction coefficient is at least 0", "0 is ice, 1 holds well");
        link.collisions.push_back({c.where, name_of(c), in.pose_of(c), read_shape(in, c), friction});
    });
    each(e, "visual", [&](const xml::Element& v) {
        link.visuals.push_back({v.where, name_of(v), in.pose_of(v), read_shape(in, v), read_material(in, v)});
    });
    each(e, "sensor", [&](const xml::Element& s) { read_sensor(in, s, link); });
    return link;
}

void read_joint(SdfSource& in, const xml::Element& e, Model& model) {
    static const std::vector<std::string> types = {"revolute",   "revolute2", "prismatic", "ball",
                                                   "screw",      "universal", "fixed",     "gearbox",
                                                   "continuous", "piston"};
    const std::string type = attribute_of(e, "type");
    const bool known = std::find(types.begin(), types.end(), type) != types.end();
    if (!known)
        in.diagnostics.error(e.where, fmt::format("there is no joint of type '{}'", type),
                             suggest(type, types));
    if (text_of(e, "parent") == text_of(e, "child"))
        in.diagnostics.error(e.where,
                             fmt::format("joint '{}' ties '{}' to itself", name_of(e), text_of(e, "child")),
                             "<parent> and <child> name two links");
    const auto* axis = e.child("axis");
    if (type != "revolute" || !axis) {
        if (known && type != "fixed")
            in.diagnostics.warning(
                e.where, fmt::format("joint '{}' does not turn here", name_of(e)),
                type == "revolute" ? "give it an <axis>" : "only joints of type=\"revolute\" do, about z");
        return;
    }
    Hinge hinge;
    hinge.where = e.where, hinge.name = name_of(e), hinge.pose = in.pose_of(e);
    hinge.parent = text_of(e, "parent"), hinge.child = text_of(e, "child");
    const Eigen::Vector3d xyz = in.value(*axis, "xyz", Eigen::Vector3d(0, 0, 1));
    hinge.lower = in.value(*axis, "limit/lower", -1e16), hinge.upper = in.value(*axis, "limit/upper", 1e16);
    if (hinge.lower == hinge.upper) return;
    if (hinge.upper - hinge.lower > 2 * std::numbers::pi)
        in.diagnostics.warning(axis->where, fmt::format("joint '{}' turns by more than a turn", hinge.name),
                               "give its <axis> a <limit> with <lower> and <upper>, in rad");
    if (std::abs(xyz.x()) > 1e-6 || std::abs(xyz.y()) > 1e-6 || xyz.z() == 0) {
        in.diagnostics.warning(
            axis->where,
            fmt::format("the axis of joint '{}' is not vertical: it does not turn here", hinge.name));
        return;
    }
    hinge.sense = xyz.z() > 0 ? 1 : -1;
    if (!(hinge.lower < hinge.upper))
        in.diagnostics.error(axis->where,
                             fmt::format("joint '{}' has its lower limit above the upper one", hinge.name),
                             fmt::format("they are {:g} and {:g} rad", hinge.lower, hinge.upper));
    model.hinges.push_back(std::move(hinge));
}

void check_joints(SdfSource& in, const Model& model) {
    std::vector<std::string> links;
    const auto collect = [&](const Model& m, const auto& again) -> void {
        for (const Link& link : m.links) links.push_back(link.name);
        for (const Model& inner : m.models) again(inner, again);
    };
    collect(model, collect);
    for (const Hinge& hinge : model.hinges)
        for (const std::string& name : {hinge.parent, hinge.child})
            if (std::find(links.begin(), links.end(), name.substr(name.rfind(':') + 1)) == links.end())
                in.diagnostics.error(
                    hinge.where, fmt::format("joint '{}' names no link of its model: '{}'", hinge.name, name),
                    suggest(name, links));
}

}  // namespace forage::bug
