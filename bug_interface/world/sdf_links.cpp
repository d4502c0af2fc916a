// Links and the joints between them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {

Link read_link(SdfSource& in, const xml::Element& e) {
    Link link;
    link.where = e.where(), link.name = e["name"].text(), link.pose = in.pose_of(e);
    if (const xml::Element inertial = e.child("inertial")) {
        link.mass = inertial.value("mass").number(1);
        link.inertia_z = inertial.value("inertia/izz").number(1);
    }
    for (const xml::Element& c : e.children("collision"))
        link.collisions.push_back({c.where(), c["name"].text(), in.pose_of(c), read_shape(in, c),
                                   c.value("surface/friction/ode/mu").number(1)});
    for (const xml::Element& v : e.children("visual"))
        if (is_simple_shape(v))  // the check of the file warns of others
            link.visuals.push_back(
                {v.where(), v["name"].text(), in.pose_of(v), read_shape(in, v), read_material(in, v)});
    for (const xml::Element& s : e.children("sensor")) read_sensor(in, s, link);
    return link;
}

void read_joint(SdfSource& in, const xml::Element& e, Model& model) {
    const std::string_view type = e["type"].view;
    if (e.value("parent").view == e.value("child").view)
        in.diagnostics.error(
            e.where(), fmt::format("joint '{}' ties '{}' to itself", e["name"].view, e.value("child").view),
            "<parent> and <child> name two links");
    const xml::Element axis = e.child("axis");
    if (type != "revolute" || !axis) {
        if (type != "fixed")
            in.diagnostics.warning(
                e.where(), fmt::format("joint '{}' does not turn here", e["name"].view),
                type == "revolute" ? "give it an <axis>" : "only joints of type=\"revolute\" do, about z");
        return;
    }
    Hinge hinge;
    hinge.where = e.where(), hinge.name = e["name"].text(), hinge.pose = in.pose_of(e);
    hinge.parent = e.value("parent").text(), hinge.child = e.value("child").text();
    const Eigen::Vector3d xyz = read_vector(axis.value("xyz"), Eigen::Vector3d(0, 0, 1));
    hinge.lower = axis.value("limit/lower").number(-1e16),
    hinge.upper = axis.value("limit/upper").number(1e16);
    if (hinge.lower == hinge.upper) return;
    if (hinge.upper - hinge.lower > 2 * std::numbers::pi)
        in.diagnostics.warning(axis.where(), fmt::format("joint '{}' turns by more than a turn", hinge.name),
                               "give its <axis> a <limit> with <lower> and <upper>, in rad");
    if (std::abs(xyz.x()) > 1e-6 || std::abs(xyz.y()) > 1e-6 || xyz.z() == 0) {
        in.diagnostics.warning(
            axis.where(),
            fmt::format("the axis of joint '{}' is not vertical: it does not turn here", hinge.name));
        return;
    }
    hinge.sense = xyz.z() > 0 ? 1 : -1;
    if (!(hinge.lower < hinge.upper))
        in.diagnostics.error(axis.where(),
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
    for (const Hinge& hinge : model.hinges) {
        if (hinge.where.file != model.where.file) continue;  // merged, and checked with its own file
        for (const std::string& name : {hinge.parent, hinge.child})
            if (std::ranges::find(links, name.substr(name.rfind(':') + 1)) == links.end())
                in.diagnostics.error(
                    hinge.where,
                    fmt::format("joint '{}' does not name a link of its model: '{}'", hinge.name, name),
                    suggest(name, links));
    }
}

}  // namespace forage::bug
