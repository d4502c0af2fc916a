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

/// The frame that the <pose> in `parent` names; empty when it names none.
std::string_view relative_to(const xml::Element& parent) {
    const xml::Element pose = parent.child("pose");
    if (!pose) return {};
    const auto frame = pose["relative_to"].view;
    return frame.empty() ? pose["frame"].view : frame;  // "frame" until version 1.6
}

/// The model or world around an element, in which the names of frames are looked up.
xml::Element scope_of(const xml::Element& e) {
    for (auto outer = e.parent(); outer; outer = outer.parent())
        if (outer.name() == "model" || outer.name() == "world") return outer;
    return {};
}

/// The name of the frame of a model or world itself.
std::string_view own_frame(const xml::Element& scope) {
    return scope && scope.name() == "model" ? "__model__" : "world";
}

/// The name of the frame in which the pose of an element is read that names no other one.
std::string_view frame_around(const xml::Element& e) {
    const xml::Element outer = e.parent(), scope = scope_of(e);
    const auto other = e.name() == "joint"      ? e.value("child").view
                       : e.name() == "frame"    ? e["attached_to"].view
                       : outer.name() == "link" ? outer["name"].view
                                                : std::string_view();
    return other.empty() ? own_frame(scope) : other;
}

/// What the numbers of a <pose> say; the identity without any.
Pose numbers_of(const xml::Element& e) {
    Pose pose = Pose::Identity();
    const std::vector<double> v = e ? e.value().numbers() : std::vector<double>();
    if (v.size() < 6) return pose;
    const double unit = in_degrees(e) ? std::numbers::pi / 180 : 1;
    const Eigen::Quaterniond q = is_quaternion(e) ? Eigen::Quaterniond(v[6], v[3], v[4], v[5]).normalized()
                                                  : rotation(unit * v[3], unit * v[4], unit * v[5]);
    pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    pose.linear() = q.toRotationMatrix();
    return pose;
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

const std::map<std::string_view, xml::Element>& SdfSource::frames_of(const xml::Element& scope) {
    const auto [found, is_new] = frames_.try_emplace(scope);
    if (!is_new) return found->second;
    for (const xml::Element& e : scope.children())
        if (e.name() == "include" && e.child("pose"))
            found->second.emplace(e.value("name").view, e);
        else if (e.name() == "frame" || e.name() == "link" || e.name() == "joint" || e.name() == "model")
            found->second.emplace(e["name"].view, e);
    return found->second;
}

std::optional<Pose> SdfSource::frame_in(const xml::Element& scope, std::string_view name, int depth) {
    if (name == own_frame(scope)) return Pose::Identity();
    if (!scope) return std::nullopt;
    const auto& frames = frames_of(scope);
    const auto found = frames.find(name);
    if (found == frames.end() || depth > 64) return std::nullopt;
    const xml::Element e = found->second;
    const auto named = relative_to(e);
    const auto base = frame_in(scope, named.empty() ? frame_around(e) : named, depth + 1);
    return base ? std::optional<Pose>(*base * numbers_of(e.child("pose"))) : std::nullopt;
}

Pose SdfSource::pose_of(const xml::Element& parent) {
    const xml::Element e = parent.child("pose");
    if (!e) return Pose::Identity();
    const std::vector<double> v = e.value().numbers();
    Pose pose = numbers_of(e);
    if (!v.empty()) check_angles(e, v);
    const auto frame = relative_to(parent), own = frame_around(parent);
    if (!frame.empty() && frame != own) {
        const auto base = frame_in(scope_of(parent), frame, 0), around = frame_in(scope_of(parent), own, 0);
        if (!base || !around)
            diagnostics.error(
                e.where(), fmt::format("this <pose> is relative to '{}', which has no place here", frame),
                "name a <frame>, link, joint or model with a <pose> of its own beside it, which is not "
                "relative to this one");
        else
            pose = around->inverse() * *base * pose;
    }
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
