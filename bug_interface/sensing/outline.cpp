#include "bug_interface/sensing/outline.h"

#include <cmath>

namespace forage::bug {

std::optional<Outline> cross_section(const Solid& solid, double height) {
    const double above = height - solid.pose.translation().z();
    Outline outline;
    outline.x = solid.pose.translation().x(), outline.y = solid.pose.translation().y();
    if (solid.kind == ShapeKind::sphere) {
        const double radius = solid.size.x() / 2;
        if (std::abs(above) >= radius) return {};
        outline.round = true;
        outline.radius = std::sqrt(radius * radius - above * above);
        return outline;
    }
    if (std::abs(above) > solid.size.z() / 2) return {};
    if (solid.kind == ShapeKind::cylinder) {
        outline.round = true;
        outline.radius = solid.size.x() / 2;
        return outline;
    }
    const double yaw = yaw_of(solid.pose);
    outline.cos_yaw = std::cos(yaw), outline.sin_yaw = std::sin(yaw);
    outline.half_x = solid.size.x() / 2, outline.half_y = solid.size.y() / 2;
    return outline;
}

Outline Transform2::operator*(const Outline& outline) const {
    Outline out = outline;
    const Eigen::Vector2d centre = *this * Eigen::Vector2d(outline.x, outline.y);
    out.x = centre.x(), out.y = centre.y();
    out.cos_yaw = cos_ * outline.cos_yaw - sin_ * outline.sin_yaw;
    out.sin_yaw = sin_ * outline.cos_yaw + cos_ * outline.sin_yaw;
    return out;
}

}  // namespace forage::bug
