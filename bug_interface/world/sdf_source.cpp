#include "bug_interface/world/sdf_source.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bug_interface/world/sdf_format.h"
#include "core/xml/check.h"

namespace forage::bug {
namespace {

bool is_quaternion(const xml::Element& pose) { return pose["rotation_format"].view == "quat_xyzw"; }
bool in_degrees(const xml::Element& pose) { return pose["degrees"].flag(false); }

/// The quaternion of three angles about the fixed axes x, y, z, in this order. The products are multiplied as
/// in other simulators of this format, so that poses are equal to the last bit.
Eigen::Quaterniond rotation(double roll, double pitch, double yaw) {
    const double phi = roll / 2, the = pitch / 2, psi = yaw / 2;
    const double w = std::cos(phi) * std::cos(the) * std::cos(psi) +
                     std::sin(phi) * std::sin(the) * std::sin(psi),
                 x = std::sin(phi) * std::cos(the) * std::cos(psi) -
                     std::cos(phi) * std::sin(the) * std::sin(psi),
                 y = std::cos(phi) * std::sin(the) * std::cos(psi) +
                     std::sin(phi) * std::cos(the) * std::sin(psi),
                 z = std::cos(phi) * std::cos(the) * std::sin(psi) -
                     std::sin(phi) * std::sin(the) * std::cos(psi);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    return {w / length, x / length, y / length, z / length};
}

/// Whether the frame that a <pose> in `parent` names is the one in which the pose is read anyway.
bool is_own_frame(std::string_view frame, const xml::Element& parent) {
    const xml::Element outer = parent.parent();
    if (parent.name() == "joint") return frame == parent.value("child").view;
    if (outer && outer.name() == "link") return frame == outer["name"].view;
    if (outer && outer.name() == "model") return frame == "__model__";
    return frame == "world";
}

}  // namespace

xml::Element SdfSource::open(const std::string& path) {
    const int errors_before = diagnostics.errors();
    return checked(xml::open(path, sdf_format(), diagnostics), errors_before);
}

xml::Element SdfSource::parse(const std::string& path, const std::string& text) {
    const int errors_before = diagnostics.errors();
    return checked(xml::open(path, text, sdf_format(), diagnostics), errors_before);
}

xml::Element SdfSource::checked(std::unique_ptr<const xml::Document> document, int errors_before) {
    if (document) xml::check(*document, sdf_format(), diagnostics);
    if (diagnostics.errors() > errors_before) return {};
    return files_.emplace_back(std::move(document))->root();
}

std::string SdfSource::found(const xml::Element& uri) const {
    return folders.find(uri.value().text(), uri.document().source->path);
}

/// Warns about angles of more than a turn, which are probably degrees, and about a quaternion in degrees.
void SdfSource::check_angles(const xml::Element& pose, const std::vector<double>& numbers) {
    if (in_degrees(pose) && is_quaternion(pose))
        diagnostics.warning(pose["degrees"].where(), "degrees have no effect on a quaternion",
                            "remove this attribute, or give three angles");
    if (in_degrees(pose) || is_quaternion(pose)) return;
    for (std::size_t i = 3; i < numbers.size(); ++i)
        if (std::abs(numbers[i]) > 2 * std::numbers::pi + 1e-3) {
            diagnostics.warning(
                pose.where(), fmt::format("an angle of {} in a <pose>: radians, not degrees?", numbers[i]),
                fmt::format("{} degrees are {:.5g} rad", numbers[i], numbers[i] * std::numbers::pi / 180));
            return;
        }
}

Pose SdfSource::pose_of(const xml::Element& parent) {
    Pose pose = Pose::Identity();
    const xml::Element e = parent.child("pose");
    if (!e) return pose;
    for (const char* attribute : {"relative_to", "frame"})  // "frame" until version 1.6
        if (const auto frame = e[attribute].view; !frame.empty() && !is_own_frame(frame, parent))
            diagnostics.error(e.where(),
                              fmt::format("this <pose> is relative to '{}', which is not supported", frame),
                              "give the pose relative to the enclosing element");
    const std::vector<double> v = e.value().numbers();
    if (v.empty()) return pose;
    check_angles(e, v);
    const double unit = in_degrees(e) ? std::numbers::pi / 180 : 1;
    const Eigen::Quaterniond q = is_quaternion(e) ? Eigen::Quaterniond(v[6], v[3], v[4], v[5]).normalized()
                                                  : rotation(unit * v[3], unit * v[4], unit * v[5]);
    pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    pose.linear() = q.toRotationMatrix();
    constexpr double farthest = 1000;  // m; contacts are found in single precision
    if (!(pose.translation().cwiseAbs().maxCoeff() <= farthest)) {
        diagnostics.error(e.where(), fmt::format("this <pose> leads more than {} m away", farthest),
                          "poses are in m");
        return Pose::Identity();
    }
    return pose;
}

Eigen::Vector3d read_vector(const xml::Value& value, const Eigen::Vector3d& otherwise) {
    const auto v = value.numbers();
    return v.size() < 3 ? otherwise : Eigen::Vector3d(v[0], v[1], v[2]);
}

Colour read_colour(const xml::Value& value, const Colour& otherwise) {
    const auto v = value.numbers();
    return v.size() < 3 ? otherwise : Colour(Eigen::Array3d(v[0], v[1], v[2]).cast<float>());
}

}  // namespace forage::bug
