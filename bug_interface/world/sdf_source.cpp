#include "bug_interface/world/sdf_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "bug_interface/world/sdf_check.h"
#include "bug_interface/world/sdf_values.h"
#include "core/base/named_file.h"

namespace forage::bug {
namespace {

constexpr std::size_t most_nodes = 10'000;  // elements and attributes of a file: any world of ours has fewer

void not_finite(const xml::Element& e, Diagnostics& diagnostics) {
    diagnostics.error(e.where, fmt::format("<{}> holds a number that is not finite", e.name));
}

bool finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

const xml::Element* SdfSource::open(const std::string& path) {
    const int errors_before = diagnostics.errors();
    constexpr std::size_t largest_file = std::size_t{32} << 20;
    auto text = read_file(path, largest_file, diagnostics);
    if (!text) return nullptr;
    auto root = xml::parse_element(path, std::move(*text), "<sdf version=\"1.4\">", most_nodes, diagnostics);
    if (root) check_sdf(*root, diagnostics);
    if (diagnostics.errors() > errors_before) return nullptr;
    return &files_.emplace_back(std::move(*root));
}

std::vector<double> SdfSource::list(const xml::Element& parent, std::string_view path, std::size_t n) {
    const auto* e = parent.child(path);
    if (!e) return {};
    auto values = numbers(e->text).values;
    if (!finite(values)) not_finite(*e, diagnostics), values.clear();
    if (values.size() < n) values.clear();
    return values;
}

double SdfSource::value(const xml::Element& parent, std::string_view path, double otherwise) {
    const auto v = list(parent, path, 1);
    return v.empty() ? otherwise : v[0];
}

int SdfSource::value(const xml::Element& parent, std::string_view path, int otherwise) {
    const auto v = list(parent, path, 1);
    constexpr double most = std::numeric_limits<int>::max();
    return v.empty() ? otherwise : static_cast<int>(std::clamp(v[0], -most, most));
}

bool SdfSource::value(const xml::Element& parent, std::string_view path, bool otherwise) {
    return truth(text_of(parent, path)).value_or(otherwise);
}

Eigen::Vector2d SdfSource::value(const xml::Element& parent, std::string_view path,
                                 const Eigen::Vector2d& otherwise) {
    const auto v = list(parent, path, 2);
    return v.empty() ? otherwise : Eigen::Vector2d(v[0], v[1]);
}

Eigen::Vector3d SdfSource::value(const xml::Element& parent, std::string_view path,
                                 const Eigen::Vector3d& otherwise) {
    const auto v = list(parent, path, 3);
    return v.empty() ? otherwise : Eigen::Vector3d(v[0], v[1], v[2]);
}

Colour SdfSource::value(const xml::Element& parent, std::string_view path, const Colour& otherwise) {
    const auto v = list(parent, path, 3);
    return v.empty() ? otherwise : Eigen::Array3d(v[0], v[1], v[2]).cast<float>();
}

/// Angles of more than a turn are likely degrees.
void SdfSource::check_angles(const xml::Element& pose) {
    if (in_degrees(pose) || is_quaternion(pose)) return;
    const auto v = numbers(pose.text).values;
    for (std::size_t i = 3; i < v.size(); ++i)
        if (std::abs(v[i]) > 2 * std::numbers::pi + 1e-3) {
            diagnostics.warning(
                pose.where, fmt::format("an angle of {} in a <pose>: radians, not degrees?", v[i]),
                fmt::format("{} degrees are {:.5g} rad", v[i], v[i] * std::numbers::pi / 180));
            return;
        }
}

Pose SdfSource::pose_of(const xml::Element& parent) {
    const auto* e = parent.child("pose");
    if (!e) return Pose::Identity();
    for (const char* attribute : {"relative_to", "frame"})  // "frame" until version 1.6
        if (!attribute_of(*e, attribute).empty())
            diagnostics.error(e->where, "poses relative to a named frame are not supported",
                              "give the pose relative to the enclosing element");
    if (!finite(numbers(e->text).values)) return not_finite(*e, diagnostics), Pose::Identity();
    check_angles(*e);
    const Pose pose = to_pose(*e);
    constexpr double farthest = 1000;  // m; contacts are found in single precision
    if (!(pose.translation().cwiseAbs().maxCoeff() <= farthest)) {
        diagnostics.error(e->where, fmt::format("this <pose> leads more than {} m away", farthest),
                          "poses are in m");
        return Pose::Identity();
    }
    return pose;
}

double SdfSource::noise_of(const xml::Element& e) {
    const double noise = value(e, "noise/stddev", 0.0);
    if (noise < 0)
        diagnostics.error(e.child("noise/stddev")->where, "a standard deviation is at least 0",
                          "0 for no noise; of a ray sensor it is in m");
    return noise;
}

double SdfSource::rate_of(const xml::Element& sensor) {
    const double rate = value(sensor, "update_rate", 0.0);
    if (rate < 0)
        diagnostics.error(sensor.where, "an <update_rate> cannot be negative",
                          "it is how often it looks in a second of the world; 0 for in every cycle");
    return rate;
}

}  // namespace forage::bug
