#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
namespace {

constexpr int most_rays = 10'000;

/// Groups get what these see.
const std::array<std::string, 3> known_rays = {"laser", "laser_target", "laser_gripper"};

}  // namespace

void read_sensor(SdfSource& in, const xml::Element& e, Link& link) {
    const std::string type = attribute_of(e, "type");
    if (type == "ray") {
        RangeSensor s;
        s.where = e.where, s.name = name_of(e), s.pose = in.pose_of(e);
        if (std::find(known_rays.begin(), known_rays.end(), s.name) == known_rays.end())
            in.diagnostics.warning(s.where,
                                   fmt::format("no group gets what a ray sensor called '{}' sees", s.name),
                                   suggest(s.name, known_rays));
        const auto* scan = e.child("ray/scan/horizontal");
        const auto* range = e.child("ray/range");
        if (!scan || !range) {
            in.diagnostics.error(
                s.where,
                fmt::format("ray sensor '{}' needs <ray> with <scan><horizontal> and <range>", s.name));
            return;
        }
        const int errors_before = in.diagnostics.errors();
        s.rays = in.value(*scan, "samples", 640);
        s.first_angle = in.value(*scan, "min_angle", 0.0), s.last_angle = in.value(*scan, "max_angle", 0.0);
        s.min_range = in.value(*range, "min", 0.0), s.max_range = in.value(*range, "max", 0.0);
        s.noise = in.noise_of(*e.child("ray")), s.rate = in.rate_of(e);
        if (in.diagnostics.errors() == errors_before &&
            (s.rays < 1 || s.rays > most_rays || !(s.max_range > s.min_range)))
            in.diagnostics.error(
                s.where,
                fmt::format("ray sensor '{}' needs 1 to {} samples and min < max", s.name, most_rays),
                fmt::format("it has {} samples, min {:g} m, max {:g} m", s.rays, s.min_range, s.max_range));
        link.range_sensors.push_back(std::move(s));
    } else if (type == "camera") {
        CameraSensor s;
        s.where = e.where, s.name = name_of(e), s.pose = in.pose_of(e);
        const auto* camera = e.child("camera");
        if (!camera) {
            in.diagnostics.error(s.where, fmt::format("camera sensor '{}' needs <camera>", s.name));
            return;
        }
        s.horizontal_fov = in.value(*camera, "horizontal_fov", 1.047);
        s.width = in.value(*camera, "image/width", 320), s.height = in.value(*camera, "image/height", 240);
        s.far = in.value(*camera, "clip/far", 100.0);
        s.noise = in.noise_of(*camera), s.rate = in.rate_of(e);
        if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
            in.diagnostics.error(s.where, fmt::format("camera '{}' has an impossible image size", s.name));
        if (!(s.horizontal_fov > 0 && s.horizontal_fov < 3.1))
            in.diagnostics.error(
                s.where, fmt::format("camera '{}' needs a horizontal_fov between 0 and 3.1 rad", s.name));
        if (!link.cameras.empty())
            in.diagnostics.warning(s.where, fmt::format("camera '{}' is the second one of its link", s.name),
                                   "robots see with the first one");
        link.cameras.push_back(std::move(s));
    } else {
        in.diagnostics.warning(e.where, fmt::format("a sensor of type '{}' has no effect here", type),
                               "type=\"ray\" and type=\"camera\" have");
    }
}

}  // namespace forage::bug
