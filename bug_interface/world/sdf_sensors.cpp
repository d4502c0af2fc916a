#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
void read_sensor(SdfSource& in, const xml::Element& e, Link& link) {
    const std::string_view type = e["type"].view;
    if (type == "ray") {
        RangeSensor s;
        s.where = e.where(), s.name = e["name"].text(), s.pose = in.pose_of(e);
        if (!s.use()) {
            std::vector<std::string> known;
            for (const auto& use : range_uses) known.emplace_back(use.sensor);
            in.diagnostics.warning(s.where,
                                   fmt::format("no group gets what a ray sensor called '{}' sees", s.name),
                                   suggest(s.name, known));
        }
        const xml::Element scan = e.child("ray/scan/horizontal");
        const xml::Element range = e.child("ray/range");
        if (!scan || !range) {
            in.diagnostics.error(
                s.where,
                fmt::format("ray sensor '{}' needs <ray> with <scan><horizontal> and <range>", s.name));
            return;
        }
        s.rays = scan.value("samples").whole(640);
        s.first_angle = scan.value("min_angle").number(0), s.last_angle = scan.value("max_angle").number(0);
        s.min_range = range.value("min").number(0), s.max_range = range.value("max").number(0);
        s.noise = e.value("ray/noise/stddev").number(0), s.rate = e.value("update_rate").number(0);
        if (constexpr double turn = 2 * std::numbers::pi + 1e-3;
            std::max({std::abs(s.first_angle), std::abs(s.last_angle),
                      std::abs(s.last_angle - s.first_angle)}) > turn)
            in.diagnostics.warning(
                scan.where(),
                fmt::format(
                    "ray sensor '{}' scans from {:g} to {:g}, which is more than a turn: radians, not "
                    "degrees?",
                    s.name, s.first_angle, s.last_angle),
                fmt::format("{:g} and {:g} degrees are {:.5g} and {:.5g} rad", s.first_angle, s.last_angle,
                            s.first_angle * std::numbers::pi / 180, s.last_angle * std::numbers::pi / 180));
        if (!(s.max_range > s.min_range))
            in.diagnostics.error(range.where(), fmt::format("ray sensor '{}' needs min < max", s.name),
                                 fmt::format("it has min {:g} m, max {:g} m", s.min_range, s.max_range));
        link.range_sensors.push_back(std::move(s));
    } else if (type == "camera") {
        CameraSensor s;
        s.where = e.where(), s.name = e["name"].text(), s.pose = in.pose_of(e);
        const xml::Element camera = e.child("camera");
        if (!camera) {
            in.diagnostics.error(s.where, fmt::format("camera sensor '{}' needs <camera>", s.name));
            return;
        }
        s.horizontal_fov = camera.value("horizontal_fov").number(1.047);
        s.width = camera.value("image/width").whole(320);
        s.height = camera.value("image/height").whole(240);
        s.far = camera.value("clip/far").number(100);
        s.noise = camera.value("noise/stddev").number(0), s.rate = e.value("update_rate").number(0);
        if (!link.cameras.empty())
            in.diagnostics.warning(s.where, fmt::format("camera '{}' is the second one of its link", s.name),
                                   "robots see with the first one");
        link.cameras.push_back(std::move(s));
    } else {
        in.diagnostics.warning(e.where(), fmt::format("a sensor of type '{}' has no effect here", type),
                               "type=\"ray\" and type=\"camera\" have");
    }
}

}  // namespace forage::bug
