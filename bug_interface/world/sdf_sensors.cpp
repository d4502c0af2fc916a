#include <cmath>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
namespace {

constexpr int most_rays = 10'000;

}  // namespace

void read_sensor(SdfSource& in, const sdf::ElementPtr& e, Link& link) {
    const std::string type = e->Get<std::string>("type");
    if (type == "ray") {
        RangeSensor s;
        s.where = in.at(e), s.name = name_of(e), s.pose = in.pose_of(e);
        const auto ray = child(e, {"ray"});
        const auto scan = ray ? child(ray, {"scan", "horizontal"}) : nullptr;
        const auto range = ray ? child(ray, {"range"}) : nullptr;
        if (!scan || !range) {
            in.diagnostics.error(
                s.where,
                fmt::format("ray sensor '{}' needs <ray> with <scan><horizontal> and <range>", s.name));
            return;
        }
        s.rays = in.value(scan, "samples", 1);
        s.first_angle = in.value(scan, "min_angle", 0.0), s.last_angle = in.value(scan, "max_angle", 0.0);
        s.min_range = in.value(range, "min", 0.0), s.max_range = in.value(range, "max", 1.0);
        s.noise = in.noise_of(ray), s.rate = in.rate_of(e);
        if (!(std::isfinite(s.first_angle) && std::isfinite(s.last_angle)))
            in.diagnostics.error(s.where,
                                 fmt::format("ray sensor '{}' has an angle that is not finite", s.name));
        if (s.rays < 1 || s.rays > most_rays || !(s.max_range > s.min_range))
            in.diagnostics.error(s.where, fmt::format("ray sensor '{}' needs 1 to {} samples and min < max",
                                                      s.name, most_rays));
        link.range_sensors.push_back(std::move(s));
    } else if (type == "camera") {
        CameraSensor s;
        s.where = in.at(e), s.name = name_of(e), s.pose = in.pose_of(e);
        const auto camera = child(e, {"camera"});
        if (!camera) {
            in.diagnostics.error(s.where, fmt::format("camera sensor '{}' needs <camera>", s.name));
            return;
        }
        s.horizontal_fov = in.value(camera, "horizontal_fov", 1.047);
        if (const auto image = child(camera, {"image"}))
            s.width = in.value(image, "width", 32), s.height = in.value(image, "height", 28);
        if (const auto clip = child(camera, {"clip"})) s.far = in.value(clip, "far", 20.0);
        s.noise = in.noise_of(camera), s.rate = in.rate_of(e);
        if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
            in.diagnostics.error(s.where, fmt::format("camera '{}' has an impossible image size", s.name));
        if (!(s.horizontal_fov > 0 && s.horizontal_fov < 3.1))
            in.diagnostics.error(
                s.where, fmt::format("camera '{}' needs a horizontal_fov between 0 and 3.1 rad", s.name));
        link.cameras.push_back(std::move(s));
    }
}

}  // namespace forage::bug
