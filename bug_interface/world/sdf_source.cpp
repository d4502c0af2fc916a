#include "bug_interface/world/sdf_source.h"

#include <array>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

namespace forage::bug {

void SdfSource::not_finite(const sdf::ElementPtr& e) {
    diagnostics.error(at(e), fmt::format("<{}> holds a number that is not finite", e->GetName()));
}

/// Angles of more than a turn are likely degrees.
void SdfSource::check_angles(const sdf::ElementPtr& pose) {
    for (const char* attribute : {"degrees", "rotation_format"})
        if (pose->GetAttributeSet(attribute)) return;
    std::istringstream in(pose->GetValue()->GetAsString());
    std::array<double, 6> v{};
    for (double& each : v) in >> each;
    for (std::size_t i = 3; i < v.size(); ++i)
        if (std::abs(v[i]) > 2 * std::numbers::pi + 1e-3) {
            diagnostics.warning(
                at(pose), fmt::format("an angle of {} in a <pose>: radians, not degrees?", v[i]),
                fmt::format("{} degrees are {:.5g} rad", v[i], v[i] * std::numbers::pi / 180));
            return;
        }
}

Pose SdfSource::pose_of(const sdf::ElementPtr& parent) {
    if (!parent->HasElement("pose")) return Pose::Identity();
    const auto e = parent->GetElement("pose");
    if (e->HasAttribute("relative_to") && !e->Get<std::string>("relative_to").empty())
        diagnostics.error(at(e), "poses relative to a named frame are not supported",
                          "give the pose relative to the enclosing element");
    const auto p = e->Get<ignition::math::Pose3d>();
    if (!p.IsFinite()) return not_finite(e), Pose::Identity();
    check_angles(e);
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(p.Pos().X(), p.Pos().Y(), p.Pos().Z());
    pose.linear() = Eigen::Quaterniond(p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()).toRotationMatrix();
    return pose;
}

double SdfSource::noise_of(const sdf::ElementPtr& e) {
    const auto stddev = child(e, {"noise", "stddev"});
    if (!stddev) return 0;
    const double noise = stddev->Get<double>();
    if (!(noise >= 0 && std::isfinite(noise)))
        diagnostics.error(at(stddev), "a standard deviation is a finite number, at least 0");
    return noise;
}

double SdfSource::rate_of(const sdf::ElementPtr& sensor) {
    const double rate = value(sensor, "update_rate", 0.0);
    if (rate < 0) diagnostics.error(at(sensor), "an <update_rate> cannot be negative");
    return rate;
}

}  // namespace forage::bug
