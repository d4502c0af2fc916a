#include "bug_interface/world/sdf_values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/number.h"

namespace forage::bug {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The quaternion of three angles, in the order in which other simulators of this format multiply: worlds
/// stand where they stand there, to the last bit.
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

}  // namespace

NumberList numbers(std::string_view text) {
    NumberList out;
    for (auto from = text.find_first_not_of(blanks); from != text.npos;
         from = text.find_first_not_of(blanks)) {
        text.remove_prefix(from);
        const std::string_view word = text.substr(0, text.find_first_of(blanks));
        std::string_view rest = word;
        const auto value = take_number<double>(rest);  // may be infinite
        if (!value || !rest.empty()) {
            out.wrong = word;
            break;
        }
        out.values.push_back(*value);
        text.remove_prefix(word.size());
    }
    return out;
}

std::optional<bool> truth(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (lower == "true" || lower == "1") return true;
    if (lower == "false" || lower == "0") return false;
    return {};
}

std::optional<int> sdf_version(std::string_view text) {
    if (!text.starts_with("1.")) return {};
    const auto minor = parse_number<int>(text.substr(2));
    return minor && *minor >= 0 ? minor : std::nullopt;
}

bool is_quaternion(const xml::Element& pose) {
    const auto* format = pose.attribute("rotation_format");
    return format && format->value == "quat_xyzw";
}

bool in_degrees(const xml::Element& pose) {
    const auto* degrees = pose.attribute("degrees");
    return degrees && truth(degrees->value).value_or(false);
}

Pose to_pose(const xml::Element& e) {
    const auto v = numbers(e.text).values;
    Pose pose = Pose::Identity();
    if (v.size() != size_of(e)) return pose;
    pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
    const double unit = in_degrees(e) ? std::numbers::pi / 180 : 1;
    const Eigen::Quaterniond q = is_quaternion(e) ? Eigen::Quaterniond(v[6], v[3], v[4], v[5]).normalized()
                                                  : rotation(unit * v[3], unit * v[4], unit * v[5]);
    pose.linear() = q.toRotationMatrix();
    return pose;
}

}  // namespace forage::bug
