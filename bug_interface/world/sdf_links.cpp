// Links and the joints between them.
#include <cmath>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {

Link read_link(SdfSource& in, const sdf::ElementPtr& e) {
    Link link;
    link.where = in.at(e), link.name = name_of(e), link.pose = in.pose_of(e);
    if (const auto inertial = child(e, {"inertial"})) {
        link.mass = in.value(inertial, "mass", 1.0);
        if (const auto izz = child(inertial, {"inertia", "izz"})) link.inertia_z = izz->Get<double>();
        if (!(link.mass > 0 && link.inertia_z > 0))
            in.diagnostics.error(in.at(inertial), "mass and inertia must be positive");
    }
    each(e, "collision", [&](const sdf::ElementPtr& c) {
        const auto friction = child(c, {"surface", "friction", "ode"});
        link.collisions.push_back({in.at(c), name_of(c), in.pose_of(c), read_shape(in, c),
                                   friction ? in.value(friction, "mu", 1.0) : 1.0});
    });
    each(e, "visual", [&](const sdf::ElementPtr& v) {
        link.visuals.push_back(
            {in.at(v), name_of(v), in.pose_of(v), read_shape(in, v), read_material(in, v)});
    });
    each(e, "sensor", [&](const sdf::ElementPtr& s) { read_sensor(in, s, link); });
    return link;
}

void read_joint(SdfSource& in, const sdf::ElementPtr& e, Model& model) {
    const auto axis = child(e, {"axis"});
    if (e->Get<std::string>("type") != "revolute" || !axis) return;
    Hinge hinge;
    hinge.where = in.at(e), hinge.name = name_of(e), hinge.pose = in.pose_of(e);
    hinge.parent = in.value(e, "parent", std::string()), hinge.child = in.value(e, "child", std::string());
    const auto xyz = in.value(axis, "xyz", ignition::math::Vector3d(0, 0, 1));
    if (const auto limit = child(axis, {"limit"}))
        hinge.lower = in.value(limit, "lower", -1e16), hinge.upper = in.value(limit, "upper", 1e16);
    if (hinge.lower == hinge.upper) return;
    if (std::abs(xyz.X()) > 1e-6 || std::abs(xyz.Y()) > 1e-6 || xyz.Z() == 0) {
        in.diagnostics.warning(
            in.at(axis),
            fmt::format("the axis of joint '{}' is not vertical: it does not turn here", hinge.name));
        return;
    }
    hinge.sense = xyz.Z() > 0 ? 1 : -1;
    if (!(hinge.lower < hinge.upper))
        in.diagnostics.error(in.at(axis),
                             fmt::format("joint '{}' has its lower limit above the upper one", hinge.name));
    model.hinges.push_back(std::move(hinge));
}

}  // namespace forage::bug
